//! The core at work: the model clock by clock inserts a set of points, and JavaScript watches it.
#![allow(unsafe_code)] // names of functions that JavaScript calls

use std::cell::RefCell;

use incircle_geometry::order::{along_curve, rounds};
use incircle_geometry::Point;
use incircle_model::{Activity, ClockModel, ContextView, Inputs};
use incircle_protocol::{clear_word, command_word, Config, Opcode, FULL};

use crate::border::{give, told};
use crate::deal::deal;
use crate::grid::grid_points;

/// Stands for a vertex or a context that there is not.
const NONE: u32 = u32::MAX;
/// Most clocks of one call whose activities are listed; a call may run more.
const LISTED_CLOCKS: u32 = 1024;
/// Bits of a listed activity: above the number of the activity.
const IS_ENDING: u32 = 1 << 3;
const HAS_PRIORITY: u32 = 1 << 4;
/// Number of words in the answers to `Clear` and `Insert` after which the job is done.
const ANSWER_WORDS: usize = 2 * incircle_protocol::ANSWER_HEAD_WORDS + incircle_protocol::INSERT_REPORT_WORDS;

/// A job on the core.
struct Job {
    core: ClockModel,
    config: Config,
    /// The index that the caller gave each vertex.
    order: Vec<u32>,
    places: Vec<Point>,
    words: Vec<u32>,
    sent: usize,
    answered: usize,
    clocks: u32,
    /// The number of attempts that ended without a commit.
    retries: u32,
    was: Vec<ContextView>,
}

thread_local! {
    static JOB: RefCell<Option<Job>> = const { RefCell::new(None) };
}

impl Job {
    fn new(points: &[Point], contexts: u32) -> Result<Self, String> {
        let config = Config { contexts, ..FULL }.check().map_err(|error| error.to_string())?;
        if points.len() > config.points as usize {
            return Err(format!("the core holds {} points, and here are {}", config.points, points.len()));
        }
        let mut rounds = rounds(&along_curve(points));
        if rounds.start_with_a_triangle(points).is_none() {
            return Err("all points lie on one line: the core inserts only sets with a triangle".to_owned());
        }
        let order = deal(rounds, contexts);
        let places: Vec<Point> = order.iter().map(|&index| points[index as usize]).collect();
        let mut words = vec![clear_word(contexts), command_word(Opcode::Insert), points.len() as u32];
        words.extend(places.iter().map(|place| place.x | place.y << 16));
        let mut core = ClockModel::new(config).map_err(|error| error.to_string())?;
        // After a reset the core clears its memories, which nobody needs to watch.
        while !core.outputs().command_ready {
            core.clock(Inputs::default());
        }
        let was = core.contexts();
        Ok(Self { core, config, order, places, words, sent: 0, answered: 0, clocks: 0, retries: 0, was })
    }

    fn is_done(&self) -> bool {
        self.answered == ANSWER_WORDS
    }

    /// Simulates a clock, unless the job is done.
    fn clock(&mut self) {
        let outputs = self.core.outputs();
        self.answered += outputs.answer_words().count();
        let word = self.words.get(self.sent).copied();
        self.sent += usize::from(word.is_some() && outputs.command_ready);
        self.core.clock(Inputs {
            reset: false,
            command_valid: word.is_some(),
            command_data: word.unwrap_or_default(),
            response_ready: true,
        });
        self.clocks += 1;
        let contexts = self.core.contexts();
        let begins_rest =
            |(was, is): (&ContextView, &ContextView)| was.activity != Activity::Rest && is.activity == Activity::Rest;
        self.retries += self.was.iter().zip(&contexts).filter(|&pair| begins_rest(pair)).count() as u32;
        self.was = contexts;
    }

    /// Runs, and returns the activities of all contexts at the last clocks.
    fn run(&mut self, clocks: u32) -> Vec<u32> {
        let mut listed = Vec::new();
        for left in (0..clocks).rev() {
            if self.is_done() {
                break;
            }
            self.clock();
            if left < LISTED_CLOCKS {
                listed.extend(self.was.iter().map(activity));
            }
        }
        listed
    }

    /// The index that the caller gave to a vertex.
    fn index(&self, vertex: u32) -> u32 {
        self.order.get(vertex as usize).copied().unwrap_or(NONE)
    }

    /// For each record: its three vertices, the context that holds its lock, and whether it is in the cavity of that
    /// context.
    fn records(&self) -> Vec<u32> {
        (0..self.core.records())
            .flat_map(|id| {
                let vertices = self.core.record(id).v;
                let holder = self.core.lock_holder(id);
                let in_cavity = holder.is_some_and(|holder| self.is_in_cavity(vertices, &self.was[holder as usize]));
                let [a, b, c] = vertices.map(|vertex| self.index(vertex));
                [a, b, c, holder.unwrap_or(NONE), u32::from(in_cavity)]
            })
            .collect()
    }

    /// Whether a record with these vertices conflicts with the point of a context, which grows its cavity.
    fn is_in_cavity(&self, vertices: [u32; 3], context: &ContextView) -> bool {
        let Some(point) = context.vertex.and_then(|vertex| self.places.get(vertex as usize)) else {
            return false;
        };
        if context.is_ending {
            return false;
        }
        let at = |place: &Point| incircle_model::predicate::Point { x: place.x, y: place.y };
        let corner = |vertex: u32| self.places.get(vertex as usize).map(at);
        match vertices.map(corner) {
            [Some(a), Some(b), Some(c)] => incircle_model::predicate::finite_conflict([a, b, c], at(point)),
            [Some(a), Some(b), None] | [None, Some(a), Some(b)] | [Some(b), None, Some(a)] => {
                incircle_model::predicate::ghost_conflict(a, b, at(point))
            }
            _ => false,
        }
    }

    /// Clocks, finished points, retries, locks that are held, visits in flight, whether the job is done.
    fn figures(&self) -> Vec<u32> {
        let locks = (0..2 * self.config.points).filter(|&id| self.core.lock_holder(id).is_some()).count();
        vec![
            self.clocks,
            self.core.finished_points(),
            self.retries,
            locks as u32,
            self.core.visits().count() as u32,
            u32::from(self.is_done()),
        ]
    }
}

/// The activity of a context, with its marks, as one number.
fn activity(context: &ContextView) -> u32 {
    context.activity as u32
        | if context.is_ending { IS_ENDING } else { 0 }
        | if context.has_priority { HAS_PRIORITY } else { 0 }
}

fn with_job(ask: impl FnOnce(&mut Job)) -> f64 {
    JOB.with_borrow_mut(|job| match job {
        Some(job) => {
            ask(job);
            0.0
        }
        None => told(Err("there is no job: start one first")),
    })
}

/// Starts a job with the points in the buffer on a core with this many contexts.
#[no_mangle]
pub extern "C" fn core_start(contexts: u32) -> f64 {
    told(grid_points().and_then(|points| Job::new(&points, contexts)).map(|job| {
        JOB.set(Some(job));
        0.0
    }))
}

/// Runs at most this many clocks. The list has, for each of the last of them, the activity of every context.
#[no_mangle]
pub extern "C" fn core_run(clocks: u32) -> f64 {
    with_job(|job| {
        let listed = job.run(clocks);
        give(vec![listed]);
    })
}

/// Lists the state: figures, the activity and the index of the point of each context, records with their locks, and
/// context and record of each visit in flight.
#[no_mangle]
pub extern "C" fn core_state() -> f64 {
    with_job(|job| {
        let contexts = job
            .was
            .iter()
            .flat_map(|context| [activity(context), context.vertex.map_or(NONE, |vertex| job.index(vertex))]);
        let visits = job.core.visits().flat_map(|visit| [visit.context, visit.record]);
        give(vec![job.figures(), contexts.collect(), job.records(), visits.collect()]);
    })
}

//! `incircle replay`: a script of changes and questions in; answers, the mesh at the end, and a film out.

use std::path::PathBuf;
use std::time::Duration;

use incircle::DeviceAddress;
use serde_json::{json, Map, Value};

use crate::arguments::ReplayArguments;
use crate::backend::{self, Backend, Choice, MODEL_COORD_BITS};
use crate::connections::Connections;
use crate::failure::{counted, Failure};
use crate::formats::MeshFormat;
use crate::lattice::{self, Laid, Numbers};
use crate::output::{self, Output, Written};
use crate::path::{self, is_standard};
use crate::plan::Request;
use crate::player::{self, Player};
use crate::script::{self, Answer, Film, Script, FORMS};
use crate::watch::{seconds_json, total, Watch};
use crate::{interrupt, solve, source};

/// Reads the script, carries it out, writes what was asked for, and prints the report.
pub fn run(arguments: &ReplayArguments) -> Result<(), Failure> {
    let outputs = Outputs::prepare(arguments)?;
    let choice = choose(arguments)?;
    let mut watch = Watch::start();
    let name = path::name(&arguments.script);
    let in_file = |failure: Failure| failure.in_file(&name);
    let script = source::read_script(&arguments.script, arguments.quiet)?;
    // A device keeps no constraints: the processor takes the changes of a script with some, as for other devices.
    let choice = if script.has_constraints() { choice } else { choice.with_runs_for(script.most_living)? };
    watch.ended("load");
    interrupt::check()?;
    let laid = lattice::lay(&script.places, None).map_err(in_file)?;
    let living = script.living();
    let numbers = laid.numbers.select(&script.last_places(&living));
    let check_bits = |bits: u32| check_bits(&laid, bits, choice.address.name()).map_err(in_file);
    if choice.is_core() || matches!(choice.address, DeviceAddress::Model { .. }) {
        check_bits(choice.coord_bits)?;
    }
    outputs.check_points(&script).map_err(in_file)?;
    watch.ended("quantise");
    // A device that cannot be opened ends the run before the work.
    let mut film = arguments.film.is_some().then(|| Film::plan(&script, arguments.frames)).transpose()?;
    let mut device = open(&choice, &numbers, script.most_living, arguments)?;
    watch.ended("open");
    let player = Player { script: &script, film: film.as_mut(), quiet: arguments.quiet };
    let keeps = |device| player::keeps_living_meshes(device, check_bits);
    let lives = !script.has_constraints() && device.as_mut().map_or(Ok(false), keeps)?;
    let played = match (&mut device, &laid.numbers) {
        (Some(device), Numbers::Grid(points)) if lives => player.play_on(device, points, &arguments.job),
        (device, numbers) => player.play(numbers, device.is_none()),
    };
    let played = played.map_err(in_file)?;
    watch.ended("replay");
    let mesh = match &mut device {
        Some(device) if !lives => {
            let solved = solve::triangulate(device, &numbers, check_bits, &arguments.job, arguments.quiet);
            let mut mesh = solved.map_err(in_file)?.0;
            let request = Request::of_constraints(script.last_constraints(&living));
            if request.has_constraints() {
                let forced = request.force_numbers(&numbers, living.len(), &mut mesh);
                forced.map_err(|error| in_file(Failure::input(error.to_string())))?;
            }
            mesh
        }
        _ => played.mesh,
    };
    watch.ended("triangulate");
    let (living_count, film) = (living.len(), film.as_ref());
    let told = Told { script: &script, laid: &laid, mesh: &mesh, living: living_count, device, lives, film };
    let written = outputs.write(&script, &living, &mesh, &played.answers, film)?;
    watch.ended("write");
    output::finish(written, || told.tell(arguments, &watch.stages))
}

/// The back end of the arguments, which makes the mesh at the end.
fn choose(arguments: &ReplayArguments) -> Result<Choice, Failure> {
    let mut choice = Choice::of(&arguments.backend, None, "cpu")?;
    if matches!(choice.address, DeviceAddress::Model { coord_bits: None, .. }) {
        choice.coord_bits = MODEL_COORD_BITS;
    }
    let has_threads = matches!(choice.address, DeviceAddress::Cpu { threads: Some(_) });
    if has_threads || arguments.backend.threads.is_some() {
        return Err(Failure::usage("replay changes the mesh on one thread: leave the number of threads out"));
    }
    Ok(choice)
}

/// Refuses places that a device with coordinates of `bits` bits cannot take.
fn check_bits(laid: &Laid<'_>, bits: u32, device: &str) -> Result<(), Failure> {
    laid.beyond_bits(bits).map_or(Ok(()), |have| {
        Err(Failure::input(format!(
            "{have}, questions included, but {device} has coordinates of {bits} bits: give --backend cpu"
        )))
    })
}

/// Opens the device of the run; `None` for the back end `cpu`, where the triangulation that takes the changes gives the
/// mesh. `most_living` is the most points that live at one time.
fn open(
    choice: &Choice,
    living: &Numbers<'_>,
    most_living: usize,
    arguments: &ReplayArguments,
) -> Result<Option<Backend>, Failure> {
    // A device with runs keeps the mesh throughout.
    let room = if choice.has_runs() { most_living } else { choice.room_for(living) };
    let backend = backend::open_with_room(choice, Some(room), None, arguments.job.timeout)?;
    backend.check_job(&arguments.job)?;
    Ok(Some(backend).filter(|backend| !backend.takes_all_numbers()))
}

/// The outputs of a run, checked before the work.
struct Outputs {
    mesh: Option<(Output, MeshFormat)>,
    answers: Option<Output>,
    film: Option<Output>,
}

impl Outputs {
    fn prepare(arguments: &ReplayArguments) -> Result<Self, Failure> {
        let named = [&arguments.output, &arguments.answers, &arguments.film];
        let standard = named.iter().filter(|file| file.as_deref().is_some_and(is_standard)).count();
        if standard + usize::from(arguments.json) > 1 {
            return Err(Failure::usage(
                "only one of mesh, answers, film and the report of --json can go to standard output: give the others \
                 files",
            ));
        }
        let format = arguments.output.as_deref().map(|file| source::mesh_format(file, arguments.format)).transpose()?;
        let prepare = |file: &Option<PathBuf>| match file {
            Some(file) => Output::prepare(file, std::slice::from_ref(&arguments.script)).map(Some),
            None => Ok(None),
        };
        let [mesh, answers, film] = [prepare(named[0])?, prepare(named[1])?, prepare(named[2])?];
        let all: Vec<&Output> = [&mesh, &answers, &film].into_iter().flatten().collect();
        let is_twice = |number: usize| all[..number].iter().any(|earlier| earlier.is_same(all[number]));
        if (1..all.len()).any(is_twice) {
            return Err(Failure::usage("two of mesh, answers and film have the same file: choose another for one"));
        }
        Ok(Self { mesh: mesh.zip(format), answers, film })
    }

    /// Refuses points whose coordinates the format of the mesh would change.
    fn check_points(&self, script: &Script) -> Result<(), Failure> {
        self.mesh.as_ref().map_or(Ok(()), |(_, format)| format.check_points(&script.places))
    }

    /// Writes all outputs. `mesh` counts the living points, and the files name their indices.
    fn write(
        self,
        script: &Script,
        living: &[u32],
        mesh: &Connections,
        answers: &[Answer],
        film: Option<&Film>,
    ) -> Result<Vec<Written>, Failure> {
        let mut written = Vec::new();
        if let Some((output, format)) = self.mesh {
            written.push(match format {
                // A picture of deleted points would be wrong.
                MeshFormat::Svg => output.write(|out| mesh.write(&script.living_points(), format, out)),
                _ => output.write(|out| mesh.renamed(living).write(&script.all_points(), format, out)),
            }?);
        }
        if let Some(output) = self.answers {
            written.push(output.write(|out| script::write_answers(answers, out))?);
        }
        if let Some((output, film)) = self.film.zip(film) {
            let places = script.places.doubles();
            written.push(output.write(|out| script::write_film(film, &places, script.commands.len(), out))?);
        }
        Ok(written)
    }
}

/// The content of the report of a run.
struct Told<'a> {
    script: &'a Script,
    laid: &'a Laid<'a>,
    mesh: &'a Connections,
    living: usize,
    /// The device that made the mesh; `None` for the back end `cpu`.
    device: Option<Backend>,
    /// Whether the device took the changes and the questions as well.
    lives: bool,
    film: Option<&'a Film>,
}

impl Told<'_> {
    fn tell(&self, arguments: &ReplayArguments, stages: &[(&'static str, Duration)]) -> Result<(), Failure> {
        if arguments.json {
            return output::print(&format!("{}\n", self.to_json(stages)));
        }
        if !arguments.quiet {
            self.lines(stages).iter().for_each(|line| output::note(line));
        }
        Ok(())
    }

    fn to_json(&self, stages: &[(&'static str, Duration)]) -> Value {
        let counts = FORMS.iter().zip(self.script.counts());
        let commands: Map<String, Value> =
            counts.map(|((name, _), count)| ((*name).to_owned(), count.into())).collect();
        json!({
            "commands": commands,
            "points": self.script.insertions(),
            "living": self.living,
            "most_living": self.script.most_living,
            "duplicates": self.mesh.duplicates.len(),
            "triangles": self.mesh.triangles.len(),
            "hull": self.mesh.hull.len(),
            "changes_by": if self.lives { self.mesh_by() } else { "cpu" },
            "mesh_by": self.mesh_by(),
            "config": self.device.as_ref().and_then(|device| device.config).map(|config| config.name),
            "lattice": self.laid.to_json(),
            "film": self.film.map(|film| json!({ "frames": film.frames.len(), "commands_per_frame": film.every })),
            "seconds": seconds_json(stages),
        })
    }

    /// The name of the back end that made the mesh.
    fn mesh_by(&self) -> &'static str {
        self.device.as_ref().map_or("cpu", |device| device.name)
    }

    fn lines(&self, stages: &[(&'static str, Duration)]) -> Vec<String> {
        let counts = FORMS.iter().zip(self.script.counts());
        let counts: Vec<String> = counts.map(|((name, _), count)| format!("{count} {name}")).collect();
        let mut lines = vec![
            self.laid.line(),
            format!("{}: {}", counted(self.script.commands.len(), "command"), counts.join(", ")),
        ];
        lines.extend(self.film.map(|film| {
            let every = counted(film.every, "command");
            format!("film: {}, one after every {every}", counted(film.frames.len(), "frame"))
        }));
        let by = match self.mesh_by() {
            device if self.lives || device == "cpu" => device.to_owned(),
            device => format!("changes and answers by cpu, mesh by {device}"),
        };
        lines.push(format!(
            "{}, {}, {} on the hull; {by}, {:.3} s",
            counted(self.living, "living point"),
            counted(self.mesh.triangles.len(), "triangle"),
            counted(self.mesh.hull.len(), "point"),
            total(stages).as_secs_f64()
        ));
        lines
    }
}

//! All processes of a run, and what they send to each other.

use std::cell::Cell;
use std::io::Write;

use incircle_cli::{Exit, Failure};
use mpi::collective::SystemOperation;
use mpi::datatype::PartitionMut;
use mpi::request::{scope, WaitGuard};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives, Destination, Source};

/// The most numbers of 32 bits of a message. MPI counts them in 31 bits.
const MOST_WORDS: usize = i32::MAX as usize;

/// The exit code of a run that failed. The reason has been printed.
pub type Halt = u8;

/// The processes of a run. All of them must call the same functions in the same sequence, except where a function says
/// otherwise.
pub struct World {
    comm: SimpleCommunicator,
    rank: usize,
    size: usize,
    sent: Cell<u64>,
}

impl World {
    /// The world of all processes that `comm` connects.
    pub fn new(comm: SimpleCommunicator) -> Self {
        let (rank, size) = (comm.rank() as usize, comm.size() as usize);
        Self { comm, rank, size, sent: Cell::new(0) }
    }

    /// The number of this process, counted from 0.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// The number of processes.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Whether this is the process that prints and that makes the folder.
    pub fn is_first(&self) -> bool {
        self.rank == 0
    }

    /// The number of bytes that this process has sent to others since the last call. Any process may call this alone.
    pub fn take_sent(&self) -> u64 {
        self.sent.take()
    }

    /// Waits for all processes. If one of them failed, the one of lowest rank prints its failure, and all get its exit
    /// code.
    pub fn agree<T>(&self, own: Result<T, Failure>) -> Result<T, Halt> {
        let code = own.as_ref().err().map_or(0, |failure| failure.exit as u8);
        let mut codes = vec![0u8; self.size];
        self.comm.all_gather_into(&code, &mut codes[..]);
        let Some(first) = codes.iter().position(|&code| code != 0) else {
            // No code is left, so this process did not fail either.
            return own.map_err(|failure| failure.exit as u8);
        };
        match own {
            Err(failure) if first == self.rank => tell(&failure),
            _ => {}
        }
        Err(codes[first])
    }

    /// Prints a failure and ends all processes at once. Any process may call this alone.
    pub fn abort(&self, failure: &Failure) -> ! {
        tell(failure);
        self.comm.abort(failure.exit as i32)
    }

    /// The lists of all processes, by rank.
    pub fn gather(&self, own: &[u64]) -> Vec<Vec<u64>> {
        let mut counts = vec![0i32; self.size];
        self.comm.all_gather_into(&(own.len() as i32), &mut counts[..]);
        let displs = sums(&counts);
        let mut all = vec![0u64; counts.iter().map(|&count| count as usize).sum()];
        {
            let mut partition = PartitionMut::new(&mut all[..], counts.as_slice(), displs.as_slice());
            self.comm.all_gather_varcount_into(own, &mut partition);
        }
        self.count(own.len() * 8 * (self.size - 1));
        let mut rest = all.as_slice();
        let lists = counts.iter().map(|&count| {
            let (list, others) = rest.split_at(count as usize);
            rest = others;
            list.to_vec()
        });
        lists.collect()
    }

    /// The sums of the numbers of all processes, place by place. All lists must have the same length.
    pub fn sum(&self, own: &[u64]) -> Vec<u64> {
        let mut all = vec![0; own.len()];
        self.comm.all_reduce_into(own, &mut all[..], SystemOperation::sum());
        all
    }

    /// The greatest of the numbers of all processes.
    pub fn greatest(&self, own: u64) -> u64 {
        let mut all = 0;
        self.comm.all_reduce_into(&own, &mut all, SystemOperation::max());
        all
    }

    /// Sends a list to each process, and returns the list of each process for this one, by rank. A list that is longer
    /// than a message may be travels in several messages.
    pub fn exchange(&self, mut lists: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
        lists.resize_with(self.size, Vec::new);
        let lengths: Vec<u64> = lists.iter().map(|list| list.len() as u64).collect();
        let mut counts = vec![0u64; self.size];
        self.comm.all_to_all_into(&lengths[..], &mut counts[..]);
        let own = std::mem::take(&mut lists[self.rank]);
        // Nothing is sent from a process to itself.
        counts[self.rank] = 0;
        let mut received: Vec<Vec<u32>> = counts.iter().map(|&count| vec![0; count as usize]).collect();
        self.count(lists.iter().map(Vec::len).sum::<usize>() * 4);
        scope(|scope| {
            let mut requests = Vec::new();
            for (from, list) in received.iter_mut().enumerate() {
                let process = self.comm.process_at_rank(from as i32);
                for piece in list.chunks_mut(MOST_WORDS) {
                    requests.push(WaitGuard::from(process.immediate_receive_into(scope, piece)));
                }
            }
            let mut sends = Vec::new();
            for (to, list) in lists.iter().enumerate() {
                let process = self.comm.process_at_rank(to as i32);
                for piece in list.chunks(MOST_WORDS) {
                    sends.push(WaitGuard::from(process.immediate_send(scope, piece)));
                }
            }
        });
        received[self.rank] = own;
        received
    }

    /// Sends messages to other processes, calls `work` meanwhile, and returns when all messages have left. Some
    /// processes may call this without others, if each message is [received](World::receive) there.
    pub fn while_sending<T>(&self, messages: &[(usize, Vec<u32>)], work: impl FnOnce() -> T) -> T {
        for (_, message) in messages {
            if message.len() > MOST_WORDS {
                self.abort(&Failure::new(
                    Exit::Capacity,
                    format!("a border has {} numbers, and a message at most {MOST_WORDS}", message.len()),
                ));
            }
            self.count(message.len() * 4);
        }
        scope(|scope| {
            let _sent: Vec<_> = messages
                .iter()
                .map(|(to, message)| {
                    WaitGuard::from(self.comm.process_at_rank(*to as i32).immediate_send(scope, &message[..]))
                })
                .collect();
            work()
        })
    }

    /// The next message of a process. Messages of one process come in the sequence in which they were sent.
    pub fn receive(&self, from: usize) -> Vec<u32> {
        self.comm.process_at_rank(from as i32).receive_vec::<u32>().0
    }

    fn count(&self, bytes: usize) {
        self.sent.set(self.sent.get() + bytes as u64);
    }
}

/// Prints a failure.
fn tell(failure: &Failure) {
    // Nobody can be told that standard error is closed.
    let _ = writeln!(std::io::stderr(), "incircle-mpi: {failure}");
}

/// The sums of the counts before each count.
fn sums(counts: &[i32]) -> Vec<i32> {
    let mut sum = 0;
    let before = counts.iter().map(|&count| {
        let before = sum;
        sum += count;
        before
    });
    before.collect()
}

//! The memory that a run may take, and how many points and triangles fit it.

use std::fs;
use std::path::Path;

use crate::failure::{Exit, Failure};

/// The memory of systems that do not tell how much is free.
const USUAL: u64 = 16 << 30;
/// Bytes that a point takes, from the list of points to the mesh: 24 for its coordinates and z, and at most 200 for the
/// triangulation.
const POINT_BYTES: u64 = 224;
/// Bytes that a triangle of a mesh takes to be verified: its corners, in a list that grows, and its three edges.
const TRIANGLE_BYTES: u64 = 96;
/// Addresses that threads and the allocator reserve beside the points, in bytes.
const RESERVED: u64 = 128 << 20;

/// The memory that a run may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Memory {
    bytes: u64,
}

impl Memory {
    /// More memory than anything takes.
    pub const ENDLESS: Self = Self { bytes: u64::MAX };

    /// A memory of this many bytes.
    pub fn of_bytes(bytes: u64) -> Self {
        Self { bytes }
    }

    /// The memory that is free now: that of the machine, of the control group and of the process' own limit, whichever
    /// is least. Only Linux tells them.
    pub fn free() -> Self {
        Self { bytes: free_of(Path::new("/")).unwrap_or(USUAL) }
    }

    /// The memory in bytes.
    pub fn bytes(self) -> u64 {
        self.bytes
    }

    /// The most memory that this process has taken so far, in bytes; `None` on systems other than Linux.
    pub fn peak() -> Option<u64> {
        number_behind(Path::new("/proc/self/status"), "VmHWM:").map(|kibibytes| kibibytes * 1024)
    }

    /// Makes the allocator give each large list back to the system when it is freed. By default it keeps such memory
    /// for later, apart for each thread, so that no bound on the process could be held. Does nothing on systems other
    /// than Linux with the GNU C library.
    pub fn give_back_lists() {
        limit_kept();
    }

    /// The most bytes that an input may have, unpacked: half of the memory, because points are made of them.
    pub fn input_bytes(self) -> u64 {
        self.bytes / 2
    }

    /// The most points that fit, with their triangulation.
    pub fn most_points(self) -> u64 {
        self.bytes / POINT_BYTES
    }

    /// The bytes that this many points take, with their triangulation.
    pub fn of_points(count: u64) -> u64 {
        count.saturating_mul(POINT_BYTES)
    }

    /// Refuses generated sets that need more than these bytes. `sets` names them, and `remedy` says what to ask for.
    pub fn check_sets(self, sets: &str, bytes: u64, remedy: &str) -> Result<(), Failure> {
        if bytes <= self.bytes {
            return Ok(());
        }
        let (needed, free) = (bytes.div_ceil(1 << 20), self.bytes >> 20);
        let told = format!(
            "about {needed} MiB of memory are needed for {sets}, and {free} MiB are free: {remedy}, or use a machine \
             with more memory"
        );
        Err(Failure::new(Exit::Capacity, told))
    }

    /// Refuses more points than fit.
    #[inline]
    pub fn check_points(self, count: u64) -> Result<(), Failure> {
        if count <= self.most_points() {
            return Ok(());
        }
        let (most, mebibytes) = (self.most_points(), self.bytes >> 20);
        Err(Failure::input(format!(
            "the input has more than {most} points, which is what {mebibytes} MiB of free memory hold at {POINT_BYTES} \
             bytes a point: triangulate a part of them, or use a machine with more memory"
        )))
    }

    /// Refuses more triangles of a mesh than fit.
    #[inline]
    pub fn check_triangles(self, count: u64) -> Result<(), Failure> {
        let most = self.bytes / TRIANGLE_BYTES;
        if count <= most {
            return Ok(());
        }
        let mebibytes = self.bytes >> 20;
        Err(Failure::input(format!(
            "the mesh has more than {most} triangles, which is what {mebibytes} MiB of free memory hold at \
             {TRIANGLE_BYTES} bytes a triangle: give --memory, which keeps the rest in files, or use a machine with more \
             memory"
        )))
    }

    /// Adds a triangle of a mesh to the others, if it fits.
    pub fn push(self, triangles: &mut Vec<[u32; 3]>, triangle: [u32; 3]) -> Result<(), Failure> {
        self.check_triangles(triangles.len() as u64 + 1)?;
        triangles.push(triangle);
        Ok(())
    }
}

/// Lists of this many bytes or more have pages of their own.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const LARGE: i32 = 128 << 10;

#[cfg(all(target_os = "linux", target_env = "gnu"))]
#[allow(unsafe_code)] // no safe library offers this call
fn limit_kept() {
    // SAFETY: the call changes a number of the allocator under its own lock, and moves no memory.
    unsafe { libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE) };
}

#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
fn limit_kept() {}

/// The free memory by the files of a system whose root is this folder; `None` if they do not tell it.
fn free_of(root: &Path) -> Option<u64> {
    let machine = number_behind(&root.join("proc/meminfo"), "MemAvailable:").map(|kibibytes| kibibytes * 1024);
    [machine, addresses_of(root), group_of(root)].into_iter().flatten().min()
}

/// The addresses that the limit of the process leaves; `None` without a limit.
fn addresses_of(root: &Path) -> Option<u64> {
    let limit = number_behind(&root.join("proc/self/limits"), "Max address space")?;
    let used = number_behind(&root.join("proc/self/status"), "VmSize:").map_or(0, |kibibytes| kibibytes * 1024);
    Some(limit.saturating_sub(used).saturating_sub(RESERVED))
}

/// The least memory that the control groups of the process leave, of version 1 or 2; `None` without a limit.
fn group_of(root: &Path) -> Option<u64> {
    let groups = fs::read_to_string(root.join("proc/self/cgroup")).ok()?;
    let left = groups.lines().filter_map(|line| {
        let mut parts = line.splitn(3, ':').skip(1);
        let (controllers, path) = (parts.next()?, parts.next()?);
        let (mount, names) = match controllers {
            "" => ("sys/fs/cgroup", ["memory.max", "memory.current", "inactive_file"]),
            _ if controllers.split(',').any(|name| name == "memory") => {
                ("sys/fs/cgroup/memory", ["memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"])
            }
            _ => return None,
        };
        let mount = root.join(mount);
        // A group cannot have more than the groups that it is in.
        let folders = Path::new(path.trim_start_matches('/')).ancestors();
        folders.filter_map(|folder| left_in(&mount.join(folder), names)).min()
    });
    left.min()
}

/// The memory that one control group leaves. The pages of files that nobody used for a while count as free.
fn left_in(folder: &Path, [limit, used, cached]: [&str; 3]) -> Option<u64> {
    let limit = number_behind(&folder.join(limit), "")?;
    let used = number_behind(&folder.join(used), "").unwrap_or(0);
    let cached = number_behind(&folder.join("memory.stat"), cached).unwrap_or(0);
    Some(limit.saturating_sub(used.saturating_sub(cached)))
}

/// The number behind the first of these words at the start of a line.
fn number_behind(file: &Path, words: &str) -> Option<u64> {
    let text = fs::read_to_string(file).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(words))?;
    line.split_ascii_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MIB: u64 = 1 << 20;

    /// The free memory of a system with these files.
    fn free(name: &str, files: &[(&str, String)]) -> Option<u64> {
        let root = std::env::temp_dir().join(format!("incircle-memory-{name}-{}", std::process::id()));
        for (file, content) in files {
            let file = root.join(file);
            fs::create_dir_all(file.parent().expect("a folder")).expect("the folder can be made");
            fs::write(file, content).expect("the folder can be written");
        }
        let found = free_of(&root);
        let _ = fs::remove_dir_all(&root);
        found
    }

    #[test]
    fn the_least_limit_counts() {
        let machine = ("proc/meminfo", "MemTotal: 9000000 kB\nMemAvailable:    2097152 kB\n".to_owned());
        assert_eq!(free("none", &[]), None);
        assert_eq!(free("machine", std::slice::from_ref(&machine)), Some(2048 * MIB));
        let status = ("proc/self/status", "Name: x\nVmSize:\t  102400 kB\n".to_owned());
        let limits =
            |soft: &str| ("proc/self/limits", format!("Limit\nMax address space   {soft}   unlimited   bytes\n"));
        let within = [machine.clone(), status.clone(), limits("1073741824")];
        assert_eq!(free("addresses", &within), Some((1024 - 100 - 128) * MIB));
        assert_eq!(free("unlimited", &[machine.clone(), status, limits("unlimited")]), Some(2048 * MIB));
        let group = |path: &str, file: &'static str, number: u64| (path.to_owned() + file, number.to_string());
        let second = [
            ("proc/self/cgroup".to_owned(), "0::/a/b\n".to_owned()),
            group("sys/fs/cgroup/a/", "memory.max", 900 * MIB),
            group("sys/fs/cgroup/a/", "memory.current", 500 * MIB),
            ("sys/fs/cgroup/a/memory.stat".to_owned(), format!("anon 1\ninactive_file {}\n", 100 * MIB)),
            ("sys/fs/cgroup/a/b/memory.max".to_owned(), "max\n".to_owned()),
        ];
        let first = [
            ("proc/self/cgroup".to_owned(), "5:cpu:/x\n4:blkio,memory:/c\n".to_owned()),
            group("sys/fs/cgroup/memory/c/", "memory.limit_in_bytes", 700 * MIB),
            group("sys/fs/cgroup/memory/c/", "memory.usage_in_bytes", 300 * MIB),
        ];
        for (name, files, left) in [("second", &second[..], 500), ("first", &first[..], 400)] {
            let mut all: Vec<(&str, String)> = files.iter().map(|(path, text)| (path.as_str(), text.clone())).collect();
            all.push(machine.clone());
            assert_eq!(free(name, &all), Some(left * MIB), "{name}");
        }
    }

    #[test]
    fn points_and_triangles_are_counted() {
        let memory = Memory::of_bytes(2 * POINT_BYTES);
        assert_eq!((memory.check_points(2), memory.input_bytes()), (Ok(()), POINT_BYTES));
        assert!(memory.check_points(3).is_err_and(|failure| failure.message.contains("more than 2 points")));
        assert!(memory.check_triangles(4).is_ok() && memory.check_triangles(5).is_err());
        assert_eq!(memory.check_sets("two points", Memory::of_points(2), "ask for one"), Ok(()));
        let failure = Memory::of_bytes(3 * MIB).check_sets("all points", 4 * MIB + 1, "ask for less");
        let failure = failure.expect_err("not enough memory");
        let told =
            "about 5 MiB of memory are needed for all points, and 3 MiB are free: ask for less, or use a machine";
        assert!(failure.exit == Exit::Capacity && failure.message.starts_with(told), "{failure}");
        assert!(Memory::free().most_points() > 1000);
    }
}

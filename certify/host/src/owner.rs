//! This file says whether a file that a controller links to is the system's: then nobody changes it but who could change everything here.

use std::os::unix::fs::MetadataExt;
use std::path::Path;

/// Whose a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whose {
    /// Root's, in a folder of the system that nobody else writes to; or, where this user namespace maps not its owner, beside the C library that runs here
    /// anyway, since who can put a file there can exchange that too.
    TheSystem,
    /// In a folder of the system, of an owner that this user namespace does not map.
    CannotBeTold,
    /// Anybody's.
    Another,
}

/// Whether a file is the C library.
pub fn is_libc(file: &str) -> bool {
    let name = Path::new(file).file_name();
    name.is_some_and(|name| name.to_string_lossy().starts_with("libc.so"))
}

/// Whose a file is, its folders included; `libc` is the C library that this process runs with.
pub fn whose(file: &str, libc: Option<&String>) -> Whose {
    let Ok(file) = Path::new(file).canonicalize() else {
        return Whose::Another;
    };
    let folders = ["/lib", "/usr/lib", "/usr/local/lib"];
    let is_in = folders.iter().any(|folder| {
        let folder = Path::new(folder).canonicalize();
        folder.is_ok_and(|folder| file.starts_with(folder)) || {
            // lib64, lib32 and their kin.
            let text = file.to_string_lossy();
            text.starts_with("/lib") || text.starts_with("/usr/lib")
        }
    });
    let libc = libc.and_then(|libc| Path::new(libc).canonicalize().ok());
    let is_beside_libc = libc.is_some_and(|libc| libc.parent() == file.parent());
    let along: Option<Vec<[u32; 2]>> = file
        .ancestors()
        .map(|path| {
            std::fs::metadata(path)
                .ok()
                .map(|own| [own.uid(), own.mode()])
        })
        .collect();
    match along {
        Some(along) if is_in => judged(&along, is_beside_libc, unmapped()),
        _ => Whose::Another,
    }
}

/// Whose a file in a folder of the system is: owner and mode of it and of every folder above it, whether it lies beside the C library, and the number that
/// stands for owners who are not mapped.
fn judged(along: &[[u32; 2]], is_beside_libc: bool, unmapped: Option<u32>) -> Whose {
    let is_written_by_others = along.iter().any(|[_, mode]| mode & 0o022 != 0);
    let all_of = |is_known: &dyn Fn(u32) -> bool| along.iter().all(|[owner, _]| is_known(*owner));
    if is_written_by_others {
        Whose::Another
    } else if all_of(&|owner| owner == 0) {
        Whose::TheSystem
    } else if unmapped.is_some_and(|nobody| all_of(&|owner| owner == 0 || owner == nobody)) {
        match is_beside_libc {
            true => Whose::TheSystem,
            false => Whose::CannotBeTold,
        }
    } else {
        Whose::Another
    }
}

/// The number that stands for every owner whom this user namespace does not map; `None` where that number is somebody's.
fn unmapped() -> Option<u32> {
    let map = std::fs::read_to_string("/proc/self/uid_map").ok()?;
    let number = std::fs::read_to_string("/proc/sys/kernel/overflowuid").ok()?;
    unmapped_in(&map, number.trim().parse().ok()?)
}

fn unmapped_in(map: &str, number: u32) -> Option<u32> {
    let is_mapped = |line: &str| {
        let words: Vec<u64> = line.split_whitespace().flat_map(str::parse).collect();
        match words.as_slice() {
            [inside, _, count] => (*inside..inside.saturating_add(*count)).contains(&number.into()),
            // What cannot be read maps everybody: then nobody is trusted for it.
            _ => true,
        }
    };
    (!map.lines().any(is_mapped)).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOBODY: u32 = 65_534;

    #[test]
    fn only_what_nobody_else_can_change_is_the_system_s() {
        let root = [[0, 0o755]; 3];
        let foreign = [[NOBODY, 0o755]; 3];
        let of_user = [[0, 0o755], [1000, 0o755], [0, 0o755]];
        let open = [[0, 0o755], [0, 0o1777], [0, 0o755]];
        for (along, is_beside, unmapped, expected) in [
            (root, false, None, Whose::TheSystem),
            (foreign, true, Some(NOBODY), Whose::TheSystem),
            (foreign, false, Some(NOBODY), Whose::CannotBeTold),
            (foreign, true, None, Whose::Another),
            (of_user, true, Some(NOBODY), Whose::Another),
            (open, true, None, Whose::Another),
            (open, true, Some(NOBODY), Whose::Another),
        ] {
            assert_eq!(judged(&along, is_beside, unmapped), expected, "{along:?}");
        }
    }

    #[test]
    fn the_number_of_nobody_says_nothing_where_somebody_has_it() {
        assert_eq!(
            unmapped_in("         0       1000          1\n", NOBODY),
            Some(NOBODY)
        );
        assert_eq!(unmapped_in("0 0 4294967295\n", NOBODY), None);
        assert_eq!(unmapped_in("0 100000 65536\n", NOBODY), None);
        assert_eq!(unmapped_in("0 1000 1\n65534 2000 1\n", NOBODY), None);
        assert_eq!(unmapped_in("what is this\n", NOBODY), None);
    }

    #[test]
    fn a_file_of_this_test_is_another_s_and_the_c_library_is_the_system_s() {
        let own = std::env::current_exe().unwrap();
        assert_eq!(whose(own.to_str().unwrap(), None), Whose::Another);
        let maps = std::fs::read_to_string("/proc/self/maps").unwrap();
        let libc = maps.lines().filter_map(|line| line.get(line.find('/')?..));
        let Some(libc) = libc.map(str::to_owned).find(|file| is_libc(file)) else {
            println!("no shared C library: passed over");
            return;
        };
        assert_eq!(whose(&libc, Some(&libc)), Whose::TheSystem);
    }
}

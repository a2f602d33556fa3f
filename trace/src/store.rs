//! This file writes every output of the program: whole, or not at all.

mod folder;
mod part;

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::error::{Place, TraceError};

pub use folder::Folder;
pub use part::is_part;

/// The largest text file that is taken in at once, bytes.
const LARGEST_TEXT: u64 = 16 << 20;

/// Writes a file beside its place, flushes it to the disk and renames it, so that nothing half-written is left.
///
/// A file that stands there already is replaced, through a symbolic link too.
///
/// # Errors
/// The place is a folder or a device, or the system refuses.
pub fn write_aside(path: &Path, bytes: &[u8]) -> Result<(), TraceError> {
    write_aside_with(path, |file| file.write_all(bytes))
}

/// As [`write_aside`], with a file to write to instead of bytes.
///
/// # Errors
/// As [`write_aside`], or what the writing itself ran into.
pub fn write_aside_with(
    path: &Path,
    write: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<(), TraceError> {
    let refused = || TraceError::io("write", path);
    let place = match fs::metadata(path) {
        Ok(metadata) if metadata.is_file() => fs::canonicalize(path).map_err(refused())?,
        Ok(metadata) if metadata.is_dir() => {
            return Err(refused()(io::ErrorKind::IsADirectory.into()));
        }
        // A rename would take a device or a pipe away.
        Ok(_) => {
            return Err(refused()(io::Error::other(
                "it is no ordinary file; name one",
            )));
        }
        // A rename would take a link away that leads nowhere.
        Err(_) if fs::symlink_metadata(path).is_ok_and(|own| own.is_symlink()) => {
            let problem =
                "a link stands there that leads nowhere; take it away, or name another place";
            return Err(TraceError::recording(path, problem.to_owned()));
        }
        Err(_) => path.to_path_buf(),
    };
    let parent = parent(&place);
    let whole = aside(&parent, &OpenOptions::new(), write).map_err(refused())?;
    whole
        .persist(&place)
        .map_err(|error| refused()(error.error))?;
    sync_folder(&parent).map_err(refused())
}

/// Writes a file that must not be there yet, as whole as [`write_aside`] does; a secret one is its owner's alone from the beginning, where the system knows owners.
///
/// # Errors
/// Something stands there, a link that leads nowhere too, or the system refuses.
pub fn write_new(path: &Path, bytes: &[u8], is_secret: bool) -> Result<(), TraceError> {
    let refused = || TraceError::io("write", path);
    let mut options = OpenOptions::new();
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, if is_secret { 0o600 } else { 0o644 });
    #[cfg(not(unix))]
    let _ = is_secret;
    let parent = parent(path);
    let whole = aside(&parent, &options, |file| file.write_all(bytes)).map_err(refused())?;
    whole
        .persist_noclobber(path)
        .map_err(|error| refused()(error.error))?;
    sync_folder(&parent).map_err(refused())
}

/// A whole file in a folder, on the disk and not in its place yet; what dead processes left there goes.
fn aside(
    folder: &Path,
    options: &OpenOptions,
    write: impl FnOnce(&mut File) -> io::Result<()>,
) -> io::Result<NamedTempFile> {
    part::sweep(folder);
    let mut new = options.clone();
    new.write(true).create_new(true);
    let mut temporary = part::builder().make_in(folder, |aside| new.open(aside))?;
    part::hold(temporary.as_file());
    write(temporary.as_file_mut())?;
    temporary.as_file().sync_all()?;
    Ok(temporary)
}

/// Reads a small text file, such as a rig description.
///
/// # Errors
/// The system refuses, or the file is no UTF-8 text or larger than 16 MiB.
pub fn read_text(path: &Path) -> Result<String, TraceError> {
    let refused = || TraceError::io("read", path);
    let not_text = |problem| TraceError::NotText {
        place: Place::file(path),
        problem,
    };
    let file = File::open(path).map_err(refused())?;
    let mut bytes = Vec::new();
    file.take(LARGEST_TEXT + 1)
        .read_to_end(&mut bytes)
        .map_err(refused())?;
    if bytes.contains(&0) {
        return Err(not_text("the file holds NUL bytes, so it is no text"));
    }
    if bytes.len() as u64 > LARGEST_TEXT {
        return Err(not_text("the file is larger than 16 MiB"));
    }
    String::from_utf8(bytes).map_err(|_| not_text("the file holds bytes that are no UTF-8"))
}

/// The folder that holds a path.
fn parent(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

/// Makes a rename last through a power cut, where the system can.
fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(unix) {
        File::open(folder)?.sync_all()?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_whole_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.csv");
        write_aside(&path, b"first, and longer").unwrap();
        write_aside(&path, b"second").unwrap();
        assert_eq!(read_text(&path).unwrap(), "second");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_followed_and_a_device_is_left_alone() {
        use std::os::unix::fs::FileTypeExt;
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (
            folder.path().join("out.csv"),
            folder.path().join("link.csv"),
        );
        fs::write(&file, "earlier").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_aside(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(read_text(&file).unwrap(), "new");
        let socket = folder.path().join("socket");
        let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        let message = write_aside(&socket, b"new").unwrap_err().to_string();
        assert!(message.contains("it is no ordinary file"), "{message}");
        assert!(
            fs::symlink_metadata(&socket)
                .unwrap()
                .file_type()
                .is_socket()
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_leads_nowhere_is_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join("out.csv");
        std::os::unix::fs::symlink(folder.path().join("gone.csv"), &link).unwrap();
        let message = write_aside(&link, b"new").unwrap_err().to_string();
        assert!(
            message.contains("a link stands there that leads nowhere"),
            "{message}"
        );
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        // A link that leads to a link that leads nowhere, and one that leads to itself, are not either.
        for (name, to) in [("second.csv", "out.csv"), ("self.csv", "self.csv")] {
            let link = folder.path().join(name);
            std::os::unix::fs::symlink(to, &link).unwrap();
            assert!(write_aside(&link, b"new").is_err(), "{name}");
            assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        }
    }

    #[test]
    fn a_new_file_replaces_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("key.pem");
        write_new(&path, b"first", true).unwrap();
        let message = write_new(&path, b"second", true).unwrap_err().to_string();
        assert!(message.contains("cannot write"), "{message}");
        assert_eq!(read_text(&path).unwrap(), "first");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode = fs::metadata(&path).unwrap().permissions().mode();
            assert_eq!(mode & 0o077, 0);
            let link = folder.path().join("link.pem");
            std::os::unix::fs::symlink("gone.pem", &link).unwrap();
            assert!(write_new(&link, b"new", false).is_err());
            fs::remove_file(link).unwrap();
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_place_that_cannot_be_written_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let message = write_aside(folder.path(), b"x").unwrap_err().to_string();
        assert!(
            message.contains("cannot write") && message.contains("it is a folder"),
            "{message}"
        );
        let missing = folder.path().join("no").join("out.csv");
        let message = write_aside(&missing, b"x").unwrap_err().to_string();
        assert!(message.contains("no such file or folder"), "{message}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}

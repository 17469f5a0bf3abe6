//! Reading small files that others may have created: a FIFO, a device or an endless file must not stop the program.

use std::fs::{self, File};
use std::io::{self, Read as _};
use std::path::Path;

use crate::text;
use crate::text::OwnFault;

/// Reads a regular file of at most `most` bytes.
///
/// # Errors
/// The file does not exist, is not a regular file, is larger, or cannot be read.
pub(super) fn read_regular(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // Opening a FIFO would wait for its writer, so its type is checked first.
    let kind = fs::metadata(path)?;
    if kind.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if !kind.is_file() {
        return Err(OwnFault::error(
            io::ErrorKind::Other,
            text!("file-not-regular"),
        ));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let text = format!("it is larger than {most} bytes");
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, text));
    }
    Ok(bytes)
}

/// Reads a regular text file of at most `most` bytes.
///
/// # Errors
/// As [`read_regular`], or it is not UTF-8.
pub(super) fn read_regular_text(path: &Path, most: u64) -> io::Result<String> {
    let bytes = read_regular(path, most)?;
    String::from_utf8(bytes).map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neither_fifos_nor_devices_nor_large_files_are_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("file");
        fs::write(&path, "text").expect("written");
        assert_eq!(read_regular_text(&path, 4).expect("it fits"), "text");
        assert!(read_regular(&path, 3).is_err());
        fs::write(&path, [0xFF]).expect("written");
        assert!(read_regular_text(&path, 4).is_err());
        let fifo = folder.path().join("fifo");
        nix::unistd::mkfifo(&fifo, nix::sys::stat::Mode::S_IRWXU).expect("made");
        assert!(read_regular(&fifo, 4).is_err());
        assert!(read_regular(Path::new("/dev/zero"), 4).is_err());
        let missing = read_regular(&folder.path().join("none"), 4).expect_err("there is none");
        assert_eq!(missing.kind(), io::ErrorKind::NotFound);
    }
}

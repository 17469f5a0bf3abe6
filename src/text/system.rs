//! Errors of the operating system, in the reader's language.

use std::io::{self, ErrorKind};

use super::{Text, text};

/// A reason of the program's own, carried by an [`io::Error`].
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct OwnFault(Text);

impl OwnFault {
    /// An error with this reason.
    pub fn error(kind: ErrorKind, reason: Text) -> io::Error {
        io::Error::new(kind, Self(reason))
    }
}

/// The common kinds in words, any other error as the system names it.
impl From<&io::Error> for Text {
    fn from(error: &io::Error) -> Self {
        let own = error.get_ref().and_then(|it| it.downcast_ref::<OwnFault>());
        if let Some(OwnFault(reason)) = own {
            return reason.clone();
        }
        match error.kind() {
            ErrorKind::NotFound => text!("system-not-found"),
            ErrorKind::PermissionDenied => text!("system-forbidden"),
            ErrorKind::StorageFull => text!("system-full"),
            ErrorKind::ReadOnlyFilesystem => text!("system-read-only"),
            _ => Self::verbatim(error.to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::{Language, Locale};

    #[test]
    fn common_errors_are_said_in_the_language_of_the_reader() {
        let ukrainian = Locale::new(Language::Ukrainian);
        let said = |error: &io::Error| {
            let text = Text::from(error);
            (text.to_string(), ukrainian.text(&text))
        };
        // ENOENT, EACCES, ENOSPC, EROFS on Linux.
        for (code, english, translated) in [
            (2, "no such file or folder", "немає такого файлу чи теки"),
            (13, "permission denied", "немає дозволу"),
            (28, "no space left on the disk", "на диску немає місця"),
            (
                30,
                "the file system is read-only",
                "файлова система лише для читання",
            ),
        ] {
            let (first, second) = said(&io::Error::from_raw_os_error(code));
            assert_eq!((first.as_str(), second.as_str()), (english, translated));
        }
        let own = OwnFault::error(ErrorKind::Other, text!("file-not-regular"));
        assert_eq!(own.to_string(), "it is not a regular file");
        assert_eq!(said(&own).1, "це не звичайний файл");
        assert_eq!(said(&io::Error::other("strange")).0, "strange");
    }
}

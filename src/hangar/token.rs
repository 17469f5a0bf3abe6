//! The secret token of a hangar's service.

use std::fmt;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read as _, Write as _};
use std::os::unix::fs::{MetadataExt as _, OpenOptionsExt as _};
use std::path::{Path, PathBuf};

use rand::TryRng as _;
use rand::rngs::SysRng;
use subtle::ConstantTimeEq as _;

use crate::store::give_new_name;

/// Random bytes in a token, written as two hexadecimal digits each.
const LEN: usize = 32;
/// The mode bits for reading and writing by the owner alone.
const PRIVATE: u32 = 0o600;
/// All permissions of other users.
const OTHERS: u32 = 0o077;
/// The maximum size of a token file, in bytes: a token with some whitespace.
const FILE_MAX: u64 = 256;

/// A bearer token. `Debug` does not show it.
#[derive(Clone, PartialEq, Eq)]
pub struct HangarToken(String);

/// Why a token is not available.
#[derive(Debug, thiserror::Error)]
pub enum TokenError {
    /// The file cannot be read or created.
    #[error("cannot {what} the token file {path}: {source}")]
    File {
        what: &'static str,
        path: PathBuf,
        source: io::Error,
    },
    /// Others may read the file, so its token is not secret.
    #[error(
        "the token file {path} can be read by others (mode {mode:04o}): remove it so that a new token is created, or `chmod 600 {path}` if no one else has read it"
    )]
    Readable { path: PathBuf, mode: u32 },
    /// The file belongs to another user.
    #[error("the token file {path} belongs to another user: name another with --token-file")]
    Foreign { path: PathBuf },
    /// The file contains no valid token.
    #[error(
        "{path} contains no token ({LEN} bytes in hexadecimal digits): remove it so that a new one is created"
    )]
    Content { path: PathBuf },
    /// The system provides no random numbers.
    #[error("the system provides no random numbers for a token: {0}")]
    Random(String),
}

impl TokenError {
    /// Whether the file simply does not exist.
    pub fn is_missing(&self) -> bool {
        matches!(self, Self::File { source, .. } if source.kind() == io::ErrorKind::NotFound)
    }
}

impl fmt::Debug for HangarToken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token(..)")
    }
}

impl HangarToken {
    /// A new token from the system's random numbers.
    ///
    /// # Errors
    /// The system provides none.
    pub fn random() -> Result<Self, TokenError> {
        let mut bytes = [0; LEN];
        SysRng
            .try_fill_bytes(&mut bytes)
            .map_err(|error| TokenError::Random(error.to_string()))?;
        let digits = bytes.iter().flat_map(|byte| [byte >> 4, byte & 0xf]);
        Ok(Self(
            digits
                .filter_map(|digit| char::from_digit(u32::from(digit), 16))
                .collect(),
        ))
    }

    /// Reads a token from a file that only its owner may read.
    ///
    /// # Errors
    /// The file cannot be read, others could read it, or it does not contain a token.
    pub fn load(path: &Path) -> Result<Self, TokenError> {
        let fail = |source| TokenError::File {
            what: "read",
            path: path.to_owned(),
            source,
        };
        // Checked before opening, which would block on a pipe without a writer.
        if !fs::metadata(path).map_err(fail)?.is_file() {
            return Err(fail(io::Error::other("it is not a regular file")));
        }
        let file = File::open(path).map_err(fail)?;
        let facts = file.metadata().map_err(fail)?;
        let mode = facts.mode() & 0o7777;
        if mode & OTHERS != 0 {
            let path = path.to_owned();
            return Err(TokenError::Readable { path, mode });
        }
        if facts.uid() != nix::unistd::geteuid().as_raw() && !nix::unistd::geteuid().is_root() {
            let path = path.to_owned();
            return Err(TokenError::Foreign { path });
        }
        let mut text = String::new();
        let content = || TokenError::Content {
            path: path.to_owned(),
        };
        file.take(FILE_MAX)
            .read_to_string(&mut text)
            .map_err(|error| match error.kind() {
                io::ErrorKind::InvalidData => content(),
                _ => fail(error),
            })?;
        let text = text.trim().to_ascii_lowercase();
        let is_token = text.len() == 2 * LEN && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        if is_token {
            Ok(Self(text))
        } else {
            Err(content())
        }
    }

    /// The token in a file, which is created with a new token if missing. Several programs that
    /// create the file at once get the same token.
    ///
    /// # Errors
    /// As [`Self::load`], or the file cannot be created.
    pub fn load_or_create(path: &Path) -> Result<Self, TokenError> {
        match Self::load(path) {
            Err(error) if error.is_missing() => {
                Self::random()?.create(path)?;
                Self::load(path)
            }
            outcome => outcome,
        }
    }

    /// Writes the file completely or not at all, and never over an existing one.
    fn create(&self, path: &Path) -> Result<(), TokenError> {
        let fail = |source| TokenError::File {
            what: "make",
            path: path.to_owned(),
            source,
        };
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(fail)?;
        }
        let mut draft = path.as_os_str().to_owned();
        draft.push(format!(".{}", &Self::random()?.0[..16]));
        let draft = PathBuf::from(draft);
        let written = OpenOptions::new()
            .write(true)
            .create_new(true)
            .mode(PRIVATE)
            .open(&draft)
            .and_then(|mut file| writeln!(file, "{}", self.0).and_then(|()| file.sync_all()))
            .and_then(|()| give_new_name(&draft, path));
        let _ = fs::remove_file(&draft);
        match written {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(()),
            outcome => outcome.map_err(fail),
        }
    }

    /// Whether this token matches. The comparison takes constant time.
    pub fn matches(&self, given: &str) -> bool {
        self.0.as_bytes().ct_eq(given.as_bytes()).into()
    }

    /// The value of the `Authorization` header for this token.
    pub fn authorization(&self) -> String {
        format!("Bearer {}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::PermissionsExt as _;

    use super::*;

    #[test]
    fn a_token_is_made_once_and_only_its_owner_may_read_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("deep/token");
        let made = HangarToken::load_or_create(&path).expect("it is made");
        assert_eq!(fs::metadata(&path).expect("a file").mode() & 0o777, 0o600);
        assert_eq!(
            HangarToken::load_or_create(&path).expect("it is there"),
            made
        );
        let left: Vec<_> = fs::read_dir(folder.path().join("deep"))
            .expect("a folder")
            .collect();
        assert_eq!(left.len(), 1, "no draft is left");
        assert_ne!(HangarToken::random().expect("random"), made);
    }

    #[test]
    fn programs_that_start_together_get_the_same_token() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("token");
        let tokens: Vec<HangarToken> = std::thread::scope(|scope| {
            let all: Vec<_> = (0..8)
                .map(|_| scope.spawn(|| HangarToken::load_or_create(&path).expect("a token")))
                .collect();
            all.into_iter()
                .map(|one| one.join().expect("it ends"))
                .collect()
        });
        assert!(tokens.iter().all(|token| *token == tokens[0]));
    }

    #[test]
    fn a_file_that_others_can_read_is_refused_with_what_to_do() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("token");
        HangarToken::load_or_create(&path).expect("it is made");
        for mode in [0o640, 0o604, 0o620, 0o660] {
            fs::set_permissions(&path, fs::Permissions::from_mode(mode)).expect("it is ours");
            let error = HangarToken::load(&path).expect_err("refused").to_string();
            assert!(error.contains("chmod 600"), "{error}");
            assert!(error.contains(&format!("{mode:04o}")), "{error}");
        }
    }

    #[test]
    fn what_is_no_file_is_refused_without_waiting() {
        let folder = tempfile::tempdir().expect("a folder");
        let pipe = folder.path().join("pipe");
        let private = nix::sys::stat::Mode::S_IRUSR;
        nix::unistd::mkfifo(&pipe, private).expect("it is made");
        for path in [pipe.as_path(), folder.path(), Path::new("/dev/null")] {
            let error = HangarToken::load(path).expect_err("refused").to_string();
            assert!(error.contains("not a regular file"), "{error}");
        }
    }

    #[test]
    fn a_file_without_a_token_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("token");
        for text in ["", "secret", &"g".repeat(64), &"a".repeat(65)] {
            let _ = fs::remove_file(&path);
            OpenOptions::new()
                .write(true)
                .create_new(true)
                .mode(PRIVATE)
                .open(&path)
                .and_then(|mut file| file.write_all(text.as_bytes()))
                .expect("it is written");
            let error = HangarToken::load_or_create(&path).expect_err("refused");
            assert!(matches!(error, TokenError::Content { .. }), "{error}");
        }
    }

    #[test]
    fn only_the_token_itself_is_right_and_it_is_not_shown() {
        let token = HangarToken::random().expect("random");
        let text = token
            .authorization()
            .strip_prefix("Bearer ")
            .map(str::to_owned)
            .expect("the scheme");
        assert_eq!(text.len(), 64);
        assert!(token.matches(&text));
        for wrong in ["", &text[..63], &format!("{text}0"), &text.to_uppercase()] {
            assert!(wrong == text || !token.matches(wrong));
        }
        assert!(!format!("{token:?}").contains(&text));
    }
}

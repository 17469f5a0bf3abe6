//! Keys and signatures of files, in the format of [minisign](https://jedisct1.github.io/minisign/), which can also
//! check them. The signature of a file is next to it, with `.minisig` added to its name.

use std::fmt;
use std::fs::{self, DirBuilder, OpenOptions};
use std::io::{self, BufReader, Write as _};
use std::os::unix::fs::{DirBuilderExt as _, OpenOptionsExt as _};
use std::path::{Path, PathBuf};

use minisign::{KeyPair, PError, PublicKey, PublicKeyBox, SecretKey, SecretKeyBox, SignatureBox};

use super::regular::read_regular_text;
use crate::notice::sanitised;
use crate::text;
use crate::text::Text;

/// The maximum size of a key or a signature, in bytes.
const LONGEST: u64 = 64 * 1024;
const SIGNATURE: &str = ".minisig";
/// The names of a key's two files, as `minisign -G` uses them.
const SECRET_KEY: &str = "minisign.key";
const PUBLIC_KEY: &str = "minisign.pub";

/// A fault of a key, or the reason why a record cannot be signed.
#[derive(Debug, thiserror::Error)]
#[error("{}", Text::from(self))]
pub enum SignatureError {
    /// A file cannot be read or written.
    File { path: PathBuf, error: io::Error },
    /// The file is not a key, or the password is wrong.
    Key { path: PathBuf, why: String },
    /// The password is missing, or the program cannot ask for it.
    Password(String),
    /// A key file exists already.
    Exists(PathBuf),
    /// The record is still being written.
    BeingWritten,
}

impl From<&SignatureError> for Text {
    fn from(error: &SignatureError) -> Self {
        let shown = |path: &Path| path.display().to_string();
        match error {
            SignatureError::File { path, error } => {
                text!("sign-file", path = shown(path), error = Text::from(error))
            }
            SignatureError::Key { path, why } => {
                text!("sign-key", path = shown(path), why = why.as_str())
            }
            SignatureError::Password(why) => text!("sign-password", why = why.as_str()),
            SignatureError::Exists(path) => text!("sign-key-exists", path = shown(path)),
            SignatureError::BeingWritten => text!("sign-being-written"),
        }
    }
}

/// The secret key of a user, with which records are signed.
pub struct RecordKey(SecretKey);

impl fmt::Debug for RecordKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("RecordKey").field(&self.id()).finish()
    }
}

impl RecordKey {
    /// Reads a key file in the format of `minisign -G`. Asks on the terminal for the password of an
    /// encrypted key.
    ///
    /// # Errors
    /// The file cannot be read, is not a key, or the password is wrong.
    pub fn read(path: &Path) -> Result<Self, SignatureError> {
        let text = read_regular_text(path, LONGEST).map_err(|error| unreadable(path, error))?;
        let invalid = |error: PError| SignatureError::Key {
            path: path.to_owned(),
            why: error.to_string(),
        };
        let stored = || SecretKeyBox::from_string(&text);
        // A key without a password must not prompt for one.
        let open = stored().and_then(SecretKeyBox::into_unencrypted_secret_key);
        let key = open.or_else(|_| stored().and_then(|it| it.into_secret_key(None)));
        key.map(Self).map_err(invalid)
    }

    /// Creates a key in a folder: the two files that `minisign -G` writes. Asks on the terminal for a password, unless
    /// it should have none. Returns the id of the key, as minisign shows it, and the files.
    ///
    /// # Errors
    /// A key exists already, the files cannot be written, or no password was given.
    pub fn create(
        folder: &Path,
        has_password: bool,
    ) -> Result<(String, [PathBuf; 2]), SignatureError> {
        let files = [SECRET_KEY, PUBLIC_KEY].map(|name| folder.join(name));
        if let Some(path) = files.iter().find(|path| path.exists()) {
            return Err(SignatureError::Exists(path.clone()));
        }
        let pair = if has_password {
            KeyPair::generate_encrypted_keypair(None)
        } else {
            KeyPair::generate_unencrypted_keypair()
        };
        let failed = |error: PError| SignatureError::Password(error.to_string());
        let pair = pair.map_err(failed)?;
        let id = key_id(pair.pk.keynum());
        let secret = pair.sk.to_box(None).map_err(failed)?.into_string();
        let mut folders = DirBuilder::new();
        folders.recursive(true).mode(0o700);
        folders
            .create(folder)
            .map_err(|error| unreadable(folder, error))?;
        for (path, text, mode) in [
            (&files[0], secret, 0o600),
            (&files[1], public_file(&pair.pk), 0o644),
        ] {
            write_whole(path, &text, mode).map_err(|error| match error.kind() {
                io::ErrorKind::AlreadyExists => SignatureError::Exists(path.clone()),
                _ => unreadable(path, error),
            })?;
        }
        // The id comes from the public key, since that of the secret key is encrypted with its password.
        Ok((id, files))
    }

    /// The public key.
    ///
    /// # Errors
    /// The secret key, which was read from this file, is damaged.
    pub(super) fn public(&self, path: &Path) -> Result<RecordPublicKey, SignatureError> {
        let public = PublicKey::from_secret_key(&self.0);
        let public = public.map_err(|error| SignatureError::Key {
            path: path.to_owned(),
            why: error.to_string(),
        });
        public.map(RecordPublicKey)
    }

    /// The id of the key in hexadecimal digits, as minisign shows it.
    pub fn id(&self) -> String {
        key_id(self.0.keynum())
    }
}

/// A public key with which signatures are checked.
#[derive(Debug)]
pub struct RecordPublicKey(PublicKey);

impl RecordPublicKey {
    /// The key as text.
    pub fn text(&self) -> String {
        self.0.to_base64()
    }

    /// The key with this text, which may come from anywhere: it is never taken for a path.
    pub(super) fn from_text(text: &str) -> Option<Self> {
        PublicKey::from_base64(text).ok().map(Self)
    }

    /// Writes its file in a folder, replacing another one.
    ///
    /// # Errors
    /// It cannot be written.
    pub(super) fn write(&self, folder: &Path) -> Result<(), SignatureError> {
        let path = public_key_in(folder);
        let written = super::write(&path, &public_file(&self.0), true);
        written.map_err(|error| unreadable(&path, io::Error::other(error.to_string())))
    }

    /// Reads a public key from its text, or from a file of `minisign -G`.
    ///
    /// # Errors
    /// The argument is neither a key nor such a file.
    pub fn read(text_or_path: &str) -> Result<Self, SignatureError> {
        if let Some(key) = Self::from_text(text_or_path) {
            return Ok(key);
        }
        let path = Path::new(text_or_path);
        let text = read_regular_text(path, LONGEST).map_err(|error| unreadable(path, error))?;
        let key = PublicKeyBox::from_string(&text).and_then(PublicKeyBox::into_public_key);
        key.map(Self).map_err(|error| SignatureError::Key {
            path: path.to_owned(),
            why: error.to_string(),
        })
    }
}

/// The content of the file of a public key.
fn public_file(key: &PublicKey) -> String {
    let id = key_id(key.keynum());
    format!(
        "untrusted comment: minisign public key {id}\n{}\n",
        key.to_base64()
    )
}

/// Writes a new file, which is never seen in part.
fn write_whole(path: &Path, text: &str, mode: u32) -> io::Result<()> {
    let beside = path.with_extension(format!("{}.new", std::process::id()));
    let mut options = OpenOptions::new();
    let file = options
        .write(true)
        .create_new(true)
        .mode(mode)
        .open(&beside);
    let written = file.and_then(|mut file| {
        file.write_all(text.as_bytes())?;
        file.sync_all()
    });
    // Unlike a rename, a link replaces no file.
    let written = written.and_then(|()| fs::hard_link(&beside, path));
    drop(fs::remove_file(&beside));
    written
}

/// The file with the secret key in a folder.
pub(super) fn secret_key_in(folder: &Path) -> PathBuf {
    folder.join(SECRET_KEY)
}

/// The file with the public key in a folder.
pub(super) fn public_key_in(folder: &Path) -> PathBuf {
    folder.join(PUBLIC_KEY)
}

/// Signs a file, replacing an existing signature; the signature contains the comment `about`.
/// Returns the path of the signature.
///
/// # Errors
/// The file cannot be read, or the signature cannot be written.
pub(super) fn sign(path: &Path, key: &RecordKey, about: &str) -> Result<PathBuf, SignatureError> {
    let file = fs::File::open(path).map_err(|error| unreadable(path, error))?;
    let comment = format!("{}{about}", mark(path));
    let signed = minisign::sign(None, &key.0, BufReader::new(file), Some(&comment), None)
        .map_err(|error| SignatureError::Password(error.to_string()))?;
    let into = signature_of(path);
    super::write(&into, &signed.to_string(), true).map_err(|error| {
        let error = io::Error::other(error.to_string());
        unreadable(&into, error)
    })?;
    Ok(into)
}

#[derive(Debug, PartialEq, Eq)]
pub(super) struct FileSignature {
    /// The id of the key.
    pub key: String,
    /// The part of the signature's comment after the name of the file.
    pub about: String,
}

/// Why the signature of a file is not valid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SignatureFault {
    /// The signature cannot be read.
    Unreadable(String),
    /// The text is not a signature in minisign's format.
    Damaged,
    /// The signature was made with a key other than the given one.
    OtherKey { key: String },
    /// The file or the signature's comment was changed after signing.
    Changed,
    /// The comment names another file, or no file because another program made the signature.
    OtherFile,
    /// The signature's key or its comment differs from those of the record's other files.
    Mixed,
    /// The signed file is missing.
    Missing,
}

impl From<&SignatureFault> for Text {
    fn from(fault: &SignatureFault) -> Self {
        match fault {
            SignatureFault::Unreadable(error) => text!("sign-unreadable", error = error.as_str()),
            SignatureFault::Damaged => text!("sign-damaged"),
            SignatureFault::OtherKey { key } => text!("sign-other-key", key = key.as_str()),
            SignatureFault::Changed => text!("sign-changed"),
            SignatureFault::OtherFile => text!("sign-other-file"),
            SignatureFault::Mixed => text!("sign-mixed"),
            SignatureFault::Missing => text!("sign-missing"),
        }
    }
}

/// Reads the signature of a file, and checks it with a key, if one is given. `None` if the file has
/// no signature.
///
/// # Errors
/// The signature is damaged, belongs to another file or key, or the file was changed.
pub(super) fn check(
    path: &Path,
    key: Option<&RecordPublicKey>,
) -> Option<Result<FileSignature, SignatureFault>> {
    let unreadable = |error: io::Error| SignatureFault::Unreadable(error.to_string());
    let text = match read_regular_text(&signature_of(path), LONGEST) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return None,
        Err(error) if error.kind() == io::ErrorKind::InvalidData => {
            return Some(Err(SignatureFault::Damaged));
        }
        Err(error) => return Some(Err(unreadable(error))),
    };
    let read = || {
        if !is_whole(&text) {
            return Err(SignatureFault::Damaged);
        }
        let signature = SignatureBox::from_string(&text).map_err(|_| SignatureFault::Damaged)?;
        let by = key_id(signature.keynum());
        if let Some(RecordPublicKey(key)) = key {
            if key_id(key.keynum()) != by {
                return Err(SignatureFault::OtherKey { key: by });
            }
            let file = BufReader::new(fs::File::open(path).map_err(unreadable)?);
            minisign::verify(key, &signature, file, true, false, false)
                .map_err(|_| SignatureFault::Changed)?;
        }
        // A signature names its file, so that the signed files of a record cannot be swapped.
        let comment = signature
            .trusted_comment()
            .map_err(|_| SignatureFault::Damaged)?;
        let about = comment.strip_prefix(&mark(path));
        Ok(FileSignature {
            key: by,
            about: about.ok_or(SignatureFault::OtherFile)?.to_owned(),
        })
    };
    Some(read())
}

/// The beginning of the comment in a file's signature: the name of the file.
fn mark(path: &Path) -> String {
    format!("file:{}\t", name(path))
}

/// The name of a file, without control characters, which would end a comment.
pub(super) fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    sanitised(&name.to_string_lossy())
}

/// The path of a file's signature.
pub(super) fn signature_of(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(SIGNATURE);
    PathBuf::from(name)
}

/// Whether a signature has its four lines, with the second and the last of the required form. The library panics if
/// the last line decodes to fewer bytes.
fn is_whole(text: &str) -> bool {
    let lines: Vec<&str> = text.lines().collect();
    match lines[..] {
        // The first has two bytes for the algorithm, eight for the key and 64 for the signature; the second has 64
        // bytes.
        [_, file, _, comment] => is_base64(file, 99, "=") && is_base64(comment, 86, "=="),
        _ => false,
    }
}

/// Whether a text is base64 with this number of letters and this padding.
fn is_base64(text: &str, letters: usize, padding: &str) -> bool {
    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '+' || c == '/';
    let body = text.strip_suffix(padding);
    body.is_some_and(|body| body.len() == letters && body.chars().all(is_letter))
}

/// An id as minisign shows it: the eight bytes as a little-endian number.
fn key_id(number: &[u8]) -> String {
    let mut bytes = [0; 8];
    bytes.copy_from_slice(number);
    format!("{:016X}", u64::from_le_bytes(bytes))
}

fn unreadable(path: &Path, error: io::Error) -> SignatureError {
    SignatureError::File {
        path: path.to_owned(),
        error,
    }
}

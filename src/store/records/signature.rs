//! Signatures of a whole record. Each file of the flight is signed separately; reviews are not, since they change
//! after the flight.

use std::path::PathBuf;

use super::RecordFiles;
use crate::store::signature::{self, FileSignature, RecordKey, RecordPublicKey, SignatureError};

/// The result of checking a record's signatures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RecordSignature {
    /// No file is signed.
    None,
    /// Files are signed, but no key was given to check them: the named key is not reliable.
    Unchecked { key: String },
    /// Each file is signed by the key, with this comment.
    Valid { key: String, comment: String },
    /// A file was changed after signing, or signed with another key.
    Invalid { file: String },
    /// One file has no signature, while others have.
    Partial { file: String },
}

impl RecordFiles {
    /// The files that a flight leaves.
    fn flown(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.run, &self.inputs, &self.frames, &self.journal]
            .into_iter()
            .flatten()
    }

    /// Signs each file of the record; the signatures say `about` it. Existing signatures are replaced. Returns the
    /// signature files.
    ///
    /// # Errors
    /// A console still writes the record, a file cannot be read, or a signature cannot be written.
    pub fn sign(&self, key: &RecordKey, about: &str) -> Result<Vec<PathBuf>, SignatureError> {
        if self.is_written() {
            return Err(SignatureError::BeingWritten);
        }
        self.flown()
            .map(|path| signature::sign(path, key, about))
            .collect()
    }

    /// The state of the signatures; checked with a key, if one is given.
    pub fn signature(&self, key: Option<&RecordPublicKey>) -> RecordSignature {
        let mut found = None;
        let mut unsigned = None;
        for path in self.flown() {
            let file = || {
                let name = path.file_name().unwrap_or_default();
                name.to_string_lossy().into_owned()
            };
            match signature::check(path, key) {
                Some(Ok(signature)) => found = found.or(Some(signature)),
                Some(Err(_)) => return RecordSignature::Invalid { file: file() },
                None => unsigned = Some(file()),
            }
        }
        match (found, unsigned, key) {
            (None, _, _) => RecordSignature::None,
            (Some(_), Some(file), _) => RecordSignature::Partial { file },
            (Some(FileSignature { key, .. }), None, None) => RecordSignature::Unchecked { key },
            (Some(FileSignature { key, about }), None, Some(_)) => RecordSignature::Valid {
                key,
                comment: about,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;
    use crate::store::signature::signature_of;

    fn record(folder: &Path) -> RecordFiles {
        for ending in [".tlog", ".flight.jsonl", ".run.jsonl", ".inputs.jsonl"] {
            fs::write(folder.join(format!("flight{ending}")), ending).expect("written");
        }
        RecordFiles::beside(&folder.join("flight.tlog"))
    }

    fn keys(folder: &Path, name: &str) -> (RecordKey, RecordPublicKey) {
        let (key, files) = RecordKey::create(&folder.join(name), false).expect("a key");
        let public = RecordPublicKey::read(&files[1].to_string_lossy()).expect("its other half");
        let read = RecordKey::read(&files[0]).expect("it was written");
        assert_eq!(read.id(), key.id());
        (key, public)
    }

    #[test]
    fn a_signature_holds_for_every_file_and_for_one_key() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = record(folder.path());
        let (key, public) = keys(folder.path(), "mine");
        let (_, other) = keys(folder.path(), "other");
        assert_eq!(files.signature(Some(&public)), RecordSignature::None);
        let signatures = files.sign(&key, "score:900").expect("signed");
        assert_eq!(signatures.len(), 4);
        let unchecked = RecordSignature::Unchecked { key: key.id() };
        assert_eq!(files.signature(None), unchecked);
        let valid = RecordSignature::Valid {
            key: key.id(),
            comment: "score:900".to_owned(),
        };
        assert_eq!(files.signature(Some(&public)), valid);
        let by_other = files.signature(Some(&other));
        assert!(matches!(by_other, RecordSignature::Invalid { .. }));
        fs::write(folder.path().join("flight.inputs.jsonl"), "changed").expect("written");
        let file = "flight.inputs.jsonl".to_owned();
        assert_eq!(
            files.signature(Some(&public)),
            RecordSignature::Invalid { file }
        );
    }

    #[test]
    fn a_signature_that_is_missing_moved_or_damaged_is_noticed() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = record(folder.path());
        let (key, public) = keys(folder.path(), "mine");
        let signatures = files.sign(&key, "score:900").expect("signed");
        let text = fs::read_to_string(&signatures[0]).expect("there");
        // Each row: what becomes of the first signature.
        for at in (0..text.len()).step_by(7) {
            let mut bytes = text.clone().into_bytes();
            bytes[at] = bytes[at].wrapping_add(1) & 0x7f;
            fs::write(&signatures[0], &bytes).expect("written");
            let is_untrusted = at < text.find('\n').expect("a line");
            let is_valid = matches!(
                files.signature(Some(&public)),
                RecordSignature::Valid { .. }
            );
            assert!(is_untrusted || !is_valid, "byte {at}");
            fs::write(&signatures[0], &bytes[..at]).expect("written");
            let cut = files.signature(Some(&public));
            assert!(
                matches!(cut, RecordSignature::Invalid { .. }),
                "{at}: {cut:?}"
            );
        }
        // That of another file of the record, contents and all.
        let [run, inputs] = [&files.run, &files.inputs].map(|it| it.clone().expect("there"));
        fs::write(&signatures[0], &text).expect("written");
        fs::copy(&run, &inputs).expect("copied");
        fs::copy(&signatures[0], signature_of(&inputs)).expect("copied");
        let file = "flight.inputs.jsonl".to_owned();
        assert_eq!(
            files.signature(Some(&public)),
            RecordSignature::Invalid { file }
        );
        files.sign(&key, "score:900").expect("signed again");
        fs::remove_file(&signatures[3]).expect("there");
        let file = "flight.flight.jsonl".to_owned();
        assert_eq!(
            files.signature(Some(&public)),
            RecordSignature::Partial { file }
        );
    }

    #[test]
    fn a_key_is_for_its_owner_alone_and_never_replaced() {
        use std::os::unix::fs::PermissionsExt as _;

        let folder = tempfile::tempdir().expect("a folder");
        let (_, files) = RecordKey::create(folder.path(), false).expect("a key");
        let mode = fs::metadata(&files[0]).expect("there").permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
        let again = RecordKey::create(folder.path(), false);
        assert!(matches!(again, Err(SignatureError::Exists(_))));
        let none = RecordPublicKey::read("no/such.pub").expect_err("there is none");
        assert!(none.to_string().contains("no/such.pub"), "{none}");
        let swapped = RecordPublicKey::read(&files[0].to_string_lossy());
        assert!(matches!(swapped, Err(SignatureError::Key { .. })));
    }
}

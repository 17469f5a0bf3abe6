//! Signatures of a whole record. Each file of the flight is signed separately; reviews are not, since they change
//! after the flight.

use std::path::{Path, PathBuf};

use super::{FRAMES, INPUTS, JOURNAL, RUN, RecordFiles};
use crate::notice::sanitised;
use crate::store::signature::{
    self, FileSignature, RecordKey, RecordPublicKey, SignatureError, SignatureFault,
};

/// The result of checking a record's signatures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RecordSignature {
    /// No file is signed.
    None,
    /// All files are signed, but no key was given to check them: the named key cannot be trusted.
    Unchecked { key: String },
    /// All files are signed by the key, with this comment.
    Valid { key: String, comment: String },
    /// The signature of a file is not valid.
    Invalid { file: String, fault: SignatureFault },
    /// One file has no signature, while others have one.
    Partial { file: String },
}

/// The field of a signature's comment that lists all signed files of the record, by their endings.
const FILES: &str = "files:";

impl RecordFiles {
    /// The files of the flight itself, with their endings.
    fn flown(&self) -> impl Iterator<Item = (&'static str, &PathBuf)> {
        let files = [
            (RUN, &self.run),
            (INPUTS, &self.inputs),
            (FRAMES, &self.frames),
            (JOURNAL, &self.journal),
        ];
        let flown = files.into_iter();
        flown.filter_map(|(ending, path)| Some((ending, path.as_ref()?)))
    }

    /// The paths of the record's signature files.
    pub fn signatures(&self) -> Vec<PathBuf> {
        let paths = self.flown().map(|(_, path)| signature::signature_of(path));
        paths.filter(|path| path.is_file()).collect()
    }

    /// Signs each file of the record; the signatures contain the comment `about`. Existing
    /// signatures are replaced. Returns the signature files.
    ///
    /// # Errors
    /// A console is still writing the record, a file cannot be read, or a signature cannot be
    /// written.
    pub fn sign(&self, key: &RecordKey, about: &str) -> Result<Vec<PathBuf>, SignatureError> {
        if self.is_written() {
            return Err(SignatureError::BeingWritten);
        }
        let endings: Vec<&str> = self.flown().map(|(ending, _)| ending).collect();
        let about = format!("{about}\t{FILES}{}", endings.join(","));
        self.flown()
            .map(|(_, path)| signature::sign(path, key, &about))
            .collect()
    }

    /// The state of the signatures; checked with a key, if one is given.
    pub fn signature(&self, key: Option<&RecordPublicKey>) -> RecordSignature {
        self.checked(key).unwrap_or_else(|faulty| faulty)
    }

    fn checked(&self, key: Option<&RecordPublicKey>) -> Result<RecordSignature, RecordSignature> {
        let invalid = |path: &Path, fault| RecordSignature::Invalid {
            file: signature::name(path),
            fault,
        };
        let mut found: Option<FileSignature> = None;
        let mut unsigned = None;
        for (_, path) in self.flown() {
            match (signature::check(path, key), &found) {
                (None, _) => unsigned = Some(signature::name(path)),
                (Some(Err(fault)), _) => return Err(invalid(path, fault)),
                (Some(Ok(signature)), None) => found = Some(signature),
                (Some(Ok(signature)), Some(first)) if signature == *first => {}
                (Some(Ok(_)), Some(_)) => return Err(invalid(path, SignatureFault::Mixed)),
            }
        }
        let Some(FileSignature { key: by, about }) = found else {
            return Ok(RecordSignature::None);
        };
        if let Some(file) = unsigned {
            return Err(RecordSignature::Partial { file });
        }
        // Anyone who removes a file could also remove its signature, so the other signatures list it.
        let signed = about.split('\t').find_map(|it| it.strip_prefix(FILES));
        let missing = signed.unwrap_or_default().split(',').find(|ending| {
            let mut present = self.flown();
            !present.any(|(known, _)| known == *ending)
        });
        if let Some(ending) = missing {
            let path = PathBuf::from(format!("{}{}", self.stem, sanitised(ending)));
            return Err(invalid(&path, SignatureFault::Missing));
        }
        Ok(match key {
            None => RecordSignature::Unchecked { key: by },
            Some(_) => RecordSignature::Valid {
                key: by,
                comment: about,
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::store::signature::signature_of;

    fn record(folder: &Path) -> RecordFiles {
        for ending in [".tlog", ".flight.jsonl", ".run.jsonl", ".inputs.jsonl"] {
            fs::write(folder.join(format!("flight{ending}")), ending).expect("written");
        }
        RecordFiles::beside(&folder.join("flight.tlog"))
    }

    fn invalid(file: &str, fault: SignatureFault) -> RecordSignature {
        RecordSignature::Invalid {
            file: file.to_owned(),
            fault,
        }
    }

    fn keys(folder: &Path, name: &str) -> (RecordKey, RecordPublicKey) {
        let (id, files) = RecordKey::create(&folder.join(name), false).expect("a key");
        let public = RecordPublicKey::read(&files[1].to_string_lossy()).expect("its other half");
        let key = RecordKey::read(&files[0]).expect("it was written");
        assert_eq!(key.id(), id);
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
            comment: "score:900\tfiles:.run.jsonl,.inputs.jsonl,.tlog,.flight.jsonl".to_owned(),
        };
        assert_eq!(files.signature(Some(&public)), valid);
        let by_other = files.signature(Some(&other));
        let fault = SignatureFault::OtherKey { key: key.id() };
        assert_eq!(by_other, invalid("flight.run.jsonl", fault));
        fs::write(folder.path().join("flight.inputs.jsonl"), "changed").expect("written");
        assert_eq!(
            files.signature(Some(&public)),
            invalid("flight.inputs.jsonl", SignatureFault::Changed)
        );
    }

    #[test]
    fn a_signature_that_is_missing_moved_or_damaged_is_noticed() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = record(folder.path());
        let (key, public) = keys(folder.path(), "mine");
        let signatures = files.sign(&key, "score:900").expect("signed");
        let text = fs::read_to_string(&signatures[0]).expect("there");
        // The first signature, changed or cut off at every seventh byte.
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
        // Another file of the record together with its signature.
        let [run, inputs] = [&files.run, &files.inputs].map(|it| it.clone().expect("there"));
        fs::write(&signatures[0], &text).expect("written");
        fs::copy(&run, &inputs).expect("copied");
        fs::copy(&signatures[0], signature_of(&inputs)).expect("copied");
        assert_eq!(
            files.signature(Some(&public)),
            invalid("flight.inputs.jsonl", SignatureFault::OtherFile)
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
    fn a_signature_holds_for_the_set_of_files_and_for_one_act_of_signing() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = record(folder.path());
        let (key, public) = keys(folder.path(), "mine");
        let earlier = files.sign(&key, "score:900").expect("signed");
        let kept = fs::read(&earlier[2]).expect("there");
        files.sign(&key, "score:950").expect("signed again");
        fs::write(&earlier[2], kept).expect("written");
        let check = |files: &RecordFiles| files.signature(Some(&public));
        assert_eq!(check(&files), invalid("flight.tlog", SignatureFault::Mixed));
        // The frames are missing, with or without their signature.
        files.sign(&key, "score:950").expect("signed again");
        fs::remove_file(folder.path().join("flight.tlog")).expect("there");
        let rest = RecordFiles::beside(&folder.path().join("flight.run.jsonl"));
        let missing = invalid("flight.tlog", SignatureFault::Missing);
        assert_eq!(check(&rest), missing);
        fs::remove_file(&earlier[2]).expect("there");
        assert_eq!(check(&rest), missing);
        assert_eq!(rest.signature(None), missing);
    }

    #[test]
    fn what_is_no_signature_is_damaged_or_unreadable_and_never_missing() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = record(folder.path());
        let (key, public) = keys(folder.path(), "mine");
        let signatures = files.sign(&key, "score:900").expect("signed");
        let text = fs::read_to_string(&signatures[0]).expect("there");
        let lines: Vec<&str> = text.lines().collect();
        let damaged = invalid("flight.run.jsonl", SignatureFault::Damaged);
        // The decoder skips spaces, and the library panics if the result is then too short.
        for last in [
            " ".repeat(88),
            "\t".repeat(88),
            format!("AAAA{}", " ".repeat(84)),
        ] {
            let forged = [&lines[..3], &[last.as_str()]].concat().join("\n");
            fs::write(&signatures[0], forged).expect("written");
            assert_eq!(files.signature(Some(&public)), damaged, "{last:?}");
        }
        fs::write(&signatures[0], [0xFF, 0xFE]).expect("written");
        assert_eq!(files.signature(Some(&public)), damaged);
        fs::remove_file(&signatures[0]).expect("there");
        nix::unistd::mkfifo(&signatures[0], nix::sys::stat::Mode::S_IRWXU).expect("made");
        let found = files.signature(Some(&public));
        let RecordSignature::Invalid { fault, .. } = found else {
            panic!("{found:?}");
        };
        assert!(matches!(fault, SignatureFault::Unreadable(_)), "{fault:?}");
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

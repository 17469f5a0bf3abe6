//! `sortie records key` and `sortie records sign`: signatures that name the author of a record.

use std::env;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use clap::Args;

use super::RecordsCommands;
use crate::cli::Failure;
use crate::mission::record::Stored;
use crate::notice::sanitised;
use crate::store::{RecordFiles, RecordKey, SignatureError, read_run};
use crate::text;
use crate::text::Text;

/// Options of `sortie records key`.
#[derive(Debug, Args)]
pub(super) struct KeyArguments {
    /// Write the two files to this folder; by default minisign's (`~/.minisign`).
    #[arg(long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Leave the key without a password: anyone who can read the file can sign with it.
    #[arg(long)]
    no_password: bool,
}

/// Options of `sortie records sign`.
#[derive(Debug, Args)]
pub(super) struct SignArguments {
    /// The number in the list, or a file; by default the newest record.
    #[arg(default_value = "1")]
    record: String,
    /// Sign with this secret key; by default minisign's (`~/.minisign/minisign.key`).
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
}

impl RecordsCommands<'_> {
    pub(super) fn make_key(&self, arguments: &KeyArguments) -> Result<(), Failure> {
        let folder = arguments.output.clone().map_or_else(key_folder, Ok)?;
        let made = RecordKey::create(&folder, !arguments.no_password);
        let (id, [secret, public]) = made.map_err(|error| self.refused(&error))?;
        let text = text!(
            "sign-key-made",
            key = id,
            secret = secret.display().to_string(),
            public = public.display().to_string()
        );
        say!("{}", self.locale.text(&text))?;
        Ok(())
    }

    pub(super) fn sign(&self, arguments: &SignArguments) -> Result<(), Failure> {
        let files = self.find(&arguments.record)?;
        let path = match &arguments.key {
            Some(path) => path.clone(),
            None => key_folder()?.join("minisign.key"),
        };
        if !path.is_file() && arguments.key.is_none() {
            let text = text!("sign-no-key", path = path.display().to_string());
            return Err(self.invalid(&text));
        }
        let about = about(&files).map_err(|fault| self.invalid(&fault))?;
        let key = RecordKey::read(&path).map_err(|error| self.refused(&error))?;
        let signatures = files
            .sign(&key, &about)
            .map_err(|error| self.refused(&error))?;
        if signatures.is_empty() {
            let text = text!("replay-no-frames", file = files.stem.as_str());
            return Err(self.invalid(&text));
        }
        let text = text!("sign-signed", key = key.id(), count = signatures.len());
        say!("{}", self.locale.text(&text))?;
        for path in signatures {
            say!("  {}", path.display())?;
        }
        Ok(())
    }

    fn refused(&self, error: &SignatureError) -> Failure {
        self.invalid(&Text::from(error))
    }
}

/// The description of a flight in a signature's comment, which also names the file.
fn about(files: &RecordFiles) -> Result<String, Text> {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let mut about = vec![format!("timestamp:{}", now.unwrap_or_default().as_secs())];
    if let Some(run) = files.run.as_deref() {
        let text = read_run(run).map_err(|error| Text::verbatim(error.to_string()))?;
        let stored = Stored::read(&text)?;
        let head = &stored.head;
        about.push(format!("mission:{}", head.mission));
        about.push(format!("seed:{}", head.seed));
        about.extend(stored.end().map(|end| format!("score:{}", end.score)));
        about.push(format!("program:{}", head.program));
    }
    // A record may have been written by hand: its texts must not add fields to the comment.
    let about: Vec<_> = about.iter().map(|field| sanitised(field)).collect();
    Ok(about.join("\t"))
}

/// The folder where minisign keeps the user's key.
fn key_folder() -> Result<PathBuf, Failure> {
    let named = env::var_os("MINISIGN_CONFIG_DIR").map(PathBuf::from);
    let own = || env::home_dir().map(|home: PathBuf| Path::new(&home).join(".minisign"));
    let folder = named.filter(|path| !path.as_os_str().is_empty());
    let none = || Failure::Failed(anyhow::anyhow!("no home folder: name the key with --key"));
    folder.or_else(own).ok_or_else(none)
}

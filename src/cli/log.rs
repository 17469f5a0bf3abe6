//! The log file.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::Path;
use std::sync::Mutex;

use tracing_subscriber::EnvFilter;

use super::Failure;
use super::settings::CliSettings;
use crate::store;
use crate::text;
use crate::text::Text;

/// Starts the log, if there is to be one.
///
/// # Errors
/// The file cannot be written.
pub(super) fn start(settings: &CliSettings) -> Result<(), Failure> {
    let log = &settings.config.log;
    let Some(path) = &log.file else {
        return Ok(());
    };
    // The state folder may not exist yet.
    let state = settings
        .folders
        .as_ref()
        .map(|folders| folders.state.as_path());
    let made = match Path::new(path).parent() {
        Some(folder) if Some(folder) == state => fs::create_dir_all(folder),
        _ => Ok(()),
    };
    let file = made.and_then(|()| create_log(path)).map_err(|error| {
        let error = Text::from(&error);
        Failure::Wrong(vec![text!("log-unwritable", path = path, error = error)])
    })?;
    tracing_subscriber::fmt()
        .with_writer(Mutex::new(file))
        .with_ansi(false)
        .with_env_filter(log_filter(&log.level))
        .init();
    Ok(())
}

/// What is logged. Zenoh and its crates are always left out: their messages quote settings, among which are secret keys.
fn log_filter(level: &str) -> EnvFilter {
    let asked = level.split(',');
    let asked = asked.filter(|it| !it.trim_start().starts_with("zenoh"));
    EnvFilter::new(asked.chain(["zenoh=off"]).collect::<Vec<_>>().join(","))
}

/// Creates or empties the log file, but never through another user's symbolic link.
fn create_log(path: &str) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.create(true).write(true).truncate(true);
    store::open_own(&mut options, Path::new(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_zenoh_is_logged_whatever_is_asked_for() {
        let filter = log_filter("trace,zenoh=trace, zenoh::net=trace,zenoh_link_tls=debug");
        let filter = filter.to_string();
        assert!(
            filter.contains("zenoh=off") && filter.contains("trace"),
            "{filter}"
        );
        assert_eq!(filter.matches("zenoh").count(), 1, "{filter}");
    }
}

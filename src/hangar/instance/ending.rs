//! The end of a process, as text.

use std::io;
use std::os::unix::process::ExitStatusExt as _;
use std::process::ExitStatus;

use nix::sys::signal::Signal;

/// The end of a process, as text.
pub(super) fn words(status: io::Result<ExitStatus>) -> String {
    let status = match status {
        Ok(status) => status,
        Err(error) => return format!("its end cannot be observed: {error}"),
    };
    if let Some(code) = status.code() {
        return format!("it has exited with code {code}");
    }
    let number = status.signal().unwrap_or_default();
    match Signal::try_from(number) {
        Ok(
            signal @ (Signal::SIGABRT
            | Signal::SIGBUS
            | Signal::SIGFPE
            | Signal::SIGILL
            | Signal::SIGSEGV
            | Signal::SIGSYS
            | Signal::SIGTRAP),
        ) => format!("it has crashed ({signal})"),
        Ok(Signal::SIGXFSZ) => "it was ended for writing too large a file (SIGXFSZ)".to_owned(),
        Ok(signal) => format!("it was ended from outside ({signal})"),
        Err(_) => format!("it was ended by signal {number}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_told_in_words() {
        for (raw, expected) in [
            (3 << 8, "it has exited with code 3"),
            (0, "it has exited with code 0"),
            (6, "it has crashed (SIGABRT)"),
            (0x8b, "it has crashed (SIGSEGV)"),
            (9, "it was ended from outside (SIGKILL)"),
            (64, "it was ended by signal 64"),
        ] {
            assert_eq!(words(Ok(ExitStatus::from_raw(raw))), expected);
        }
    }
}

//! The end of a process, as text, and the files that a crash leaves.

use std::collections::BTreeSet;
use std::io;
use std::os::unix::process::ExitStatusExt as _;
use std::path::Path;
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

/// The files with the stacks of autopilots that have crashed in this folder.
pub(super) fn stacks(folder: &Path) -> BTreeSet<String> {
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names = files.map(|file| file.file_name().to_string_lossy().into_owned());
    let is_output = |name: &String| Path::new(name).extension().is_some_and(|it| it == "out");
    names
        .filter(|name| name.starts_with("dumpstack") && is_output(name))
        .collect()
}

/// A remark on what happens next and on the file with the stack; `None` without either.
pub(super) fn remark(next: Option<String>, stack: Option<&String>) -> Option<String> {
    let stack = stack.map(|file| format!("its stack is in {file}"));
    let parts: Vec<String> = next.into_iter().chain(stack).collect();
    (!parts.is_empty()).then(|| parts.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_remark_tells_what_happens_next_before_the_stack() {
        let next = || Some("is started again in 1 s".to_owned());
        let stack = "dumpstack.out".to_owned();
        let joined = "is started again in 1 s; its stack is in dumpstack.out";
        assert_eq!(remark(next(), Some(&stack)).as_deref(), Some(joined));
        let alone = "its stack is in dumpstack.out";
        assert_eq!(remark(None, Some(&stack)).as_deref(), Some(alone));
        assert_eq!(remark(next(), None), next());
        assert_eq!(remark(None, None), None);
    }

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

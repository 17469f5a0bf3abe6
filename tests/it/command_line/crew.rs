//! Crews that cannot be joined.

use super::{sortie, text};

fn joined(path: &std::path::Path) -> (Option<i32>, String) {
    let path = path.display().to_string();
    let output = sortie(&["crew", "join", &path, "--plain"]);
    (output.status.code(), text(&output.stderr))
}

#[test]
fn who_joins_a_crew_without_a_host_learns_it_at_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let crew = folder.path().join("alpha");
    let (code, said) = joined(&crew);
    assert_ne!(code, Some(0));
    assert!(said.contains("there is no crew"), "{said}");
    // The socket of a host that was killed is still there.
    std::fs::create_dir(&crew).expect("created");
    drop(std::os::unix::net::UnixListener::bind(crew.join("crew")).expect("bound"));
    let (code, said) = joined(&crew);
    assert_ne!(code, Some(0));
    assert!(said.contains("there is no crew"), "{said}");
}

#[test]
fn who_is_denied_by_the_host_ends_with_the_reason_in_one_line() {
    use std::io::{BufRead as _, BufReader, Write as _};

    let folder = tempfile::tempdir().expect("a folder");
    let crew = folder.path().join("alpha");
    std::fs::create_dir(&crew).expect("created");
    let listener = std::os::unix::net::UnixListener::bind(crew.join("crew")).expect("bound");
    let host = std::thread::spawn(move || {
        // The first connection only tries whether somebody is there.
        for stream in listener.incoming().take(2) {
            let mut stream = stream.expect("a connection");
            let mut hello = String::new();
            let mut reader = BufReader::new(stream.try_clone().expect("a second handle"));
            if reader.read_line(&mut hello).is_ok_and(|read| read > 0) {
                assert!(hello.starts_with("{\"hello\":"), "{hello}");
                let denied = stream.write_all(b"{\"denied\":{\"version\":{\"host\":9}}}\n");
                denied.expect("written");
            }
        }
    });
    let (code, said) = joined(&crew);
    host.join().expect("the host has denied");
    assert_ne!(code, Some(0));
    assert!(said.contains("the host speaks version 9"), "{said}");
    assert_eq!(said.trim().lines().count(), 1, "{said}");
}

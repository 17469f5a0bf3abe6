//! Programs that are not an `arducopter`, and instances that misbehave.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;

use nix::sys::signal::Signal;
use sortie::hangar::{HangarRefusal, Instance, InstanceId, Launch, SitlStage};
use sortie::sitl::SitlKind;

use super::{PATIENCE, Stand, is_gone, signal, until_gone};
use crate::stand_in::{Behaviour, CRASH_FILE};

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_is_no_arducopter_ends_with_the_reason() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = |name: &str, text: &str, mode: u32| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("written");
        fs::set_permissions(&path, fs::Permissions::from_mode(mode)).expect("it is ours");
        path
    };
    let text = file("text", "I am a text.\n", 0o755);
    let locked = file("locked", "#!/bin/sh\n", 0o600);
    let lost = file("lost", "#!/no/such/shell\n", 0o755);
    for (program, reason) in [
        (Path::new("/bin/ls"), "it has exited with code 2"),
        (&text, "is not a program that this machine can run"),
        (&locked, "this user may not run"),
        (&lost, "its interpreter or its loader is missing"),
        (folder.path(), "is a folder"),
        (
            Path::new("/no/such/arducopter"),
            "no program /no/such/arducopter",
        ),
    ] {
        let stand = Stand::running(program.to_owned(), |config| config);
        let id = stand.launch().await;
        let one = stand.until_ended(id).await;
        let fault = one.fault.expect("it has a reason");
        assert!(fault.contains(reason), "{fault}");
        assert_eq!(one.pid, None);
        if program == Path::new("/bin/ls") {
            assert!(one.last_output.join("\n").contains("--model"));
        }
        // An ended instance takes up no room, and can be removed.
        assert_eq!(stand.hangar.capacity().running, 0);
        stand.hangar.stop(id).await.expect("it is there");
        assert!(stand.hangar.instances().borrow().is_empty());
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_makes_no_sense_is_refused_before_anything_is_started() {
    let stand = Stand::of(Behaviour::Normal);
    let plane = Launch {
        kind: SitlKind::Plane,
        ..Launch::default()
    };
    let refused = stand.hangar.launch(plane).await;
    assert!(matches!(
        refused,
        Err(HangarRefusal::NoProgram("arduplane"))
    ));
    let backwards = Launch {
        speedup: -1.0,
        ..Launch::default()
    };
    let refused = stand.hangar.launch(backwards).await;
    assert!(matches!(refused, Err(HangarRefusal::Invalid(_))));
    assert!(matches!(
        stand.hangar.stop(1).await,
        Err(HangarRefusal::Unknown(1))
    ));
    assert!(stand.hangar.instances().borrow().is_empty());
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_that_exits_before_it_has_connected_is_shown_with_its_last_words() {
    let stand = Stand::of(Behaviour::ExitsBeforeConnecting);
    let id = stand.launch().await;
    let one = stand.until_ended(id).await;
    assert_eq!(one.fault.as_deref(), Some("it has exited with code 3"));
    assert!(one.last_output.join("\n").contains("the stand-in gives up"));
    let printed = stand.hangar.output(id, 0).expect("it is there");
    let last = printed.last().expect("it has printed").number;
    assert_eq!(stand.hangar.output(id, last).expect("it is").len(), 1);
    assert!(stand.hangar.output(id, last + 1).expect("it is").is_empty());
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_crash_is_noticed_and_told_by_its_signal() {
    let stand = Stand::of(Behaviour::Normal);
    let id = stand.launch().await;
    let one = stand.until_ready(id).await;
    fs::write(Path::new(&one.folder).join(CRASH_FILE), "").expect("written");
    let one = stand.until_ended(id).await;
    assert_eq!(one.fault.as_deref(), Some("it has crashed (SIGABRT)"));
    let last = one.last_output.join("\n");
    assert!(last.contains("Floating point exception"), "{last}");
}

/// Lets an instance crash; `stack` is the file that ArduPilot's script would write before.
async fn crash(stand: &Stand, id: InstanceId, stack: &str) -> Instance {
    let one = stand.until_ready(id).await;
    let folder = Path::new(&one.folder);
    fs::write(folder.join(stack), "#0 abort\n").expect("written");
    fs::write(folder.join(CRASH_FILE), "").expect("written");
    stand.until_ended(id).await
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_stack_of_a_crash_is_named_and_none_of_an_earlier_one() {
    let stand = Stand::of(Behaviour::Normal);
    let id = stand.launch().await;
    let stacks = [1, 7].map(|pid| format!("dumpstack.sh_arducopter.{pid}.out"));
    for stack in &stacks {
        let one = crash(&stand, id, stack).await;
        let expected = format!("its stack is in {stack}");
        assert_eq!(one.hint, Some(expected));
        stand.hangar.restart(id).await.expect("it is there");
    }
    let one = crash(&stand, id, "dumpstack.txt").await;
    assert_eq!(one.fault.as_deref(), Some("it has crashed (SIGABRT)"));
    assert_eq!(one.hint, None, "it has left no stack");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_remark_of_a_stopped_process_says_that_it_is_stopped() {
    let stand = Stand::of(Behaviour::Normal);
    let id = stand.launch().await;
    let pid = stand.until_ready(id).await.pid.expect("it runs");
    signal(pid, Signal::SIGSTOP);
    let says_so = |one: &Instance| one.hint.as_ref().is_some_and(|it| it.contains("SIGSTOP"));
    let one = stand.until_one(id, "it is diagnosed", says_so).await;
    let hint = one.hint.expect("it has one");
    let (lack, output) = hint
        .split_once("; it is stopped (SIGSTOP); its last output: ")
        .expect("in this order");
    assert!(!lack.is_empty() && !output.is_empty(), "{hint}");
    assert!(!hint.contains("of a core"), "{hint}");
}

/// A slow instance is not ended: its missing step is reported, and it can be stopped.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn those_that_hang_are_told_with_what_they_lack() {
    let stands = [Behaviour::NeverConnects, Behaviour::StaysSilent].map(Stand::of);
    let hints = [
        "runs but has not connected for",
        "is connected but has sent no heartbeat for",
    ];
    for stand in &stands {
        stand.launch().await;
    }
    for (stand, expected) in stands.iter().zip(hints) {
        let one = stand
            .until_one(1, "it is diagnosed", |one| one.hint.is_some())
            .await;
        let hint = one.hint.expect("it has one");
        assert!(hint.starts_with(expected), "{hint}");
        assert!(hint.ends_with("its last output: Starting sketch 'ArduCopter'"));
        assert_eq!(
            hint.contains(" 0 % of a core"),
            expected.contains("connected for")
        );
        assert_eq!((one.stage, one.fault), (SitlStage::Process, None));
        stand.hangar.stop(1).await.expect("it is there");
        assert!(is_gone(one.pid.expect("it ran")));
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_that_never_knows_where_it_is_stays_at_its_stage() {
    let stand = Stand::of(Behaviour::NeverReady);
    let id = stand.launch().await;
    let one = stand
        .until_one(id, "its parameters are there", |one| {
            one.stage == SitlStage::Parameters
        })
        .await;
    assert_eq!(one.parameters[0], one.parameters[1]);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_megabyte_of_output_a_second_disturbs_nobody() {
    let stand = Stand::of(Behaviour::FloodsItsOutput);
    let id = stand.launch().await;
    stand.until_ready(id).await;
    let mut numbers = stand.hangar.prints(id).expect("it is there").watch();
    let printed = timeout_of(numbers.wait_for(|last| *last > 3000)).await;
    printed.expect("it is open");
    let kept = stand.hangar.output(id, 0).expect("it is there");
    let len: usize = kept.iter().map(|line| line.text.len()).sum();
    assert!(len < 200_000, "{len}");
    stand.hangar.close().await;
}

async fn timeout_of<T>(future: impl Future<Output = T>) -> T {
    tokio::time::timeout(PATIENCE, future)
        .await
        .expect("it comes to that")
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_that_is_stopped_or_ignores_the_request_is_ended_all_the_same() {
    let stopped = Stand::of(Behaviour::Normal);
    let stubborn = Stand::of(Behaviour::IgnoresTermination);
    for stand in [&stopped, &stubborn] {
        stand.launch().await;
    }
    let pid = stopped.until_ready(1).await.pid.expect("it runs");
    signal(pid, Signal::SIGSTOP);
    stopped.hangar.stop(1).await.expect("it is there");
    assert!(is_gone(pid));
    let pid = stubborn.until_ready(1).await.pid.expect("it runs");
    stubborn.hangar.close().await;
    assert!(is_gone(pid));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_an_instance_has_started_ends_with_it() {
    let stand = Stand::of(Behaviour::HasChildren);
    let id = stand.launch().await;
    stand.until_ready(id).await;
    let printed = stand.hangar.output(id, 0).expect("it is there");
    let child = printed
        .iter()
        .find_map(|line| line.text.strip_prefix("child "))
        .and_then(|pid| pid.parse().ok())
        .expect("it says so");
    assert!(!is_gone(child));
    stand.hangar.stop(id).await.expect("it is there");
    until_gone(child).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn dropping_the_hangar_ends_everything() {
    let stand = Stand::of(Behaviour::Normal);
    let id = stand.launch().await;
    let pid = stand.until_ready(id).await.pid.expect("it runs");
    drop(stand);
    until_gone(pid).await;
}

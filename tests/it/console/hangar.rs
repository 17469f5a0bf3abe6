//! The vehicles' processes: their start, a crash, and the commands for them.

use sortie::alert::AlertKind;
use sortie::app::effect::{Effect, SessionEffect, TerminalEffect};
use sortie::app::event::{LinkEvent, ProcessEvent, SessionEvent, Started};
use sortie::app::state::{Activity, Instance, LinkSummary, Overlay, Room, SitlStage};
use sortie::campaign::Stake;
use sortie::language::ProcessDeed;
use sortie::vehicle::Severity;

use crate::fixtures;
use crate::harness::Console;

/// A vehicle's process at a stage.
pub fn instance(vehicle: u16, stage: SitlStage) -> Instance {
    Instance {
        vehicle,
        host: None,
        stage,
        parameters: if stage < SitlStage::Heartbeat {
            [0, 0]
        } else {
            [552, 1382]
        },
        pid: (stage < SitlStage::Ended).then_some(41_000 + u32::from(vehicle)),
        restarts: 0,
        memory_bytes: 8_400_000,
        processor_percent: Some(3.06),
        fault: None,
        hint: None,
        output: Vec::new(),
        folder: format!("/home/trainee/hangar/vehicle-00{vehicle}"),
    }
}

/// A process that has ended on its own.
pub fn crashed(vehicle: u16) -> Instance {
    let output = [
        "Starting sketch 'ArduCopter'",
        "bind failed on port 5760",
        "panic: it is over",
        "",
    ];
    Instance {
        fault: Some("killed by signal 9 (KILL)".to_owned()),
        output: output.map(str::to_owned).to_vec(),
        ..instance(vehicle, SitlStage::Ended)
    }
}

/// A session whose vehicles must be started first.
pub fn starting(activity: Activity, processes: usize) -> Console {
    start(Console::new(), activity, processes)
}

/// Starts a session whose vehicles must be started first.
pub fn start(mut console: Console, activity: Activity, processes: usize) -> Console {
    let is_mission = matches!(activity, Activity::Mission { .. });
    console.hear(SessionEvent::Started(Box::new(Started {
        mission: is_mission.then(|| Box::new(fixtures::listing())),
        activity,
        places: std::collections::BTreeMap::new(),
        areas: Vec::new(),
        processes: Some(processes),
        speedup: 1.0,
        is_again: false,
    })));
    console
}

pub fn hear(console: &mut Console, instances: Vec<Instance>) {
    console.hear(ProcessEvent::Instances(instances));
}

/// A session with two vehicles that are ready and parked.
fn ready() -> Console {
    let mut console = starting(Activity::Free, 2);
    hear(
        &mut console,
        vec![instance(1, SitlStage::Ready), instance(2, SitlStage::Ready)],
    );
    for id in 1..=2 {
        console.vehicle(fixtures::parked(id));
    }
    console
}

fn last_notice(console: &Console) -> (Severity, Option<u16>, String) {
    let line = console
        .state()
        .notices()
        .lines()
        .next_back()
        .expect("a notice");
    let notice = &line.notice;
    (notice.severity, notice.vehicle, notice.text.to_string())
}

#[test]
fn the_header_counts_neither_the_link_nor_the_vehicle_of_an_ended_process() {
    let mut console = ready();
    for id in 1..=2 {
        let mut vehicle = fixtures::airborne(id, 20.0, 20.0);
        vehicle.link.via = Some(id - 1);
        console.vehicle(vehicle);
    }
    let link = LinkSummary {
        up: true,
        ..LinkSummary::default()
    };
    console.hear(LinkEvent::Summaries(vec![link; 2]));
    let header = |console: &Console| {
        let screen = console.screen(200, 50);
        screen.lines().next().unwrap_or_default().to_owned()
    };
    let before = header(&console);
    assert!(
        before.contains("2/2 links") && before.contains("2 armed"),
        "{before}"
    );
    hear(
        &mut console,
        vec![crashed(1), instance(2, SitlStage::Ready)],
    );
    let after = header(&console);
    assert!(
        after.contains("1/2 links") && after.contains("1 armed"),
        "{after}"
    );
}

#[test]
fn a_session_opens_in_the_hangar_and_goes_on_when_all_are_ready() {
    let mut console = starting(Activity::Free, 2);
    assert_eq!(console.state().room(), Room::Hangar);
    hear(&mut console, vec![instance(1, SitlStage::Ready)]);
    assert_eq!(
        console.state().room(),
        Room::Hangar,
        "the other is not even there"
    );
    hear(
        &mut console,
        vec![
            instance(1, SitlStage::Ready),
            instance(2, SitlStage::Position),
        ],
    );
    assert_eq!(console.state().room(), Room::Hangar);
    console.at(7);
    hear(
        &mut console,
        vec![instance(1, SitlStage::Ready), instance(2, SitlStage::Ready)],
    );
    assert_eq!(console.state().room(), Room::Fly);
    assert_eq!(console.state().session().began_at().as_secs(), 7);
    assert_eq!(last_notice(&console).2, "all 2 vehicles are ready to arm");
}

#[test]
fn who_has_gone_elsewhere_stays_there() {
    let mut console = starting(Activity::Free, 1);
    console.press("P");
    hear(&mut console, vec![instance(1, SitlStage::Ready)]);
    assert_eq!(console.state().room(), Room::Parameters);
}

#[test]
fn escape_cancels_what_has_not_begun_without_a_question() {
    let activity = Activity::Mission {
        id: "01-air-sample".to_owned(),
        title: "Air".into(),
        stake: Stake::Graded,
    };
    let mut console = starting(activity, 2);
    hear(&mut console, vec![instance(1, SitlStage::Process)]);
    console.press("esc");
    assert_eq!(console.effects, [Effect::Session(SessionEffect::Leave)]);
    assert_eq!(console.state().room(), Room::Home);
}

#[test]
fn a_mission_takes_no_commands_before_it_begins() {
    let activity = Activity::Mission {
        id: "01-air-sample".to_owned(),
        title: "Air".into(),
        stake: Stake::Graded,
    };
    let mut console = starting(activity, 2);
    console.vehicle(fixtures::parked(1));
    hear(&mut console, vec![instance(1, SitlStage::Ready)]);
    console.give("1 arm");
    assert!(console.effects.is_empty());
    hear(
        &mut console,
        vec![instance(1, SitlStage::Ready), instance(2, SitlStage::Ready)],
    );
    console.press("esc").give("1 arm");
    assert_eq!(console.sent_to(), [1]);
}

#[test]
fn a_crash_is_told_with_the_last_line_and_leads_to_its_restart() {
    let mut console = ready();
    hear(
        &mut console,
        vec![instance(1, SitlStage::Ready), crashed(2)],
    );
    let (severity, vehicle, text) = last_notice(&console);
    assert_eq!((severity, vehicle), (Severity::Critical, Some(2)));
    assert!(
        text.contains("signal 9") && text.contains("it is over"),
        "{text}"
    );
    assert!(
        text.contains("G, then r") && text.contains("hangar restart 2"),
        "{text}"
    );
    let worst = console
        .state()
        .session()
        .alerts()
        .worst(2)
        .expect("it alarms");
    assert_eq!(worst.alert.kind, AlertKind::Process);
    assert_eq!(console.effects, [Effect::Terminal(TerminalEffect::Bell)]);
    let count = console.state().notices().lines().len();
    hear(
        &mut console,
        vec![instance(1, SitlStage::Ready), crashed(2)],
    );
    assert_eq!(
        console.state().notices().lines().len(),
        count,
        "it is told once"
    );
    console.press("G").press("r");
    assert_eq!(
        console.effects,
        [Effect::Session(SessionEffect::Process(
            ProcessDeed::Restart,
            2
        ))]
    );
    let again = |stage| Instance {
        restarts: 1,
        ..instance(2, stage)
    };
    hear(
        &mut console,
        vec![instance(1, SitlStage::Ready), again(SitlStage::Process)],
    );
    assert_eq!(
        last_notice(&console).2,
        "its process was restarted (restart 1)"
    );
    hear(
        &mut console,
        vec![instance(1, SitlStage::Ready), again(SitlStage::Ready)],
    );
    assert_eq!(last_notice(&console).2, "is ready to arm again");
    assert!(
        console
            .state()
            .session()
            .alerts()
            .of(2)
            .all(|one| one.alert.kind != AlertKind::Process)
    );
}

#[test]
fn a_crash_tells_what_happens_next() {
    let mut console = ready();
    let hint = "has failed five times in a row and is not started again";
    let given_up = Instance {
        hint: Some(hint.to_owned()),
        ..crashed(2)
    };
    hear(&mut console, vec![instance(1, SitlStage::Ready), given_up]);
    let (_, _, text) = last_notice(&console);
    assert!(text.contains(hint), "{text}");
}

#[test]
fn why_the_vehicles_could_not_be_started_stays_on_the_screen() {
    let mut console = starting(Activity::Free, 2);
    assert!(console.screen(80, 24).contains("opening the hangar"));
    let reason = "hangar 127.0.0.1:5999: it cannot be reached: is `sortie hangar` running there? \
                  From another host: `ssh -L PORT:127.0.0.1:PORT HOST`";
    console.hear(ProcessEvent::NotLaunched(reason.into()));
    console.press("n").press("esc").press("esc");
    let mut console = starting(Activity::Free, 2);
    console.hear(ProcessEvent::NotLaunched(reason.into()));
    let screen = console.screen(80, 24);
    assert!(!screen.contains("opening the hangar"), "{screen}");
    assert!(screen.contains("PORT HOST`"), "{screen}");
}

#[test]
fn the_output_of_a_process_that_runs_is_looked_at_as_long_as_it_is_on_the_screen() {
    use sortie::app::room::hangar::wanted;
    let mut console = ready();
    assert_eq!(wanted(console.state()), None);
    console.press("G").press("j");
    assert_eq!(wanted(console.state()), Some(2));
    let printed = |anew, lines: &[&str]| ProcessEvent::Printed {
        vehicle: 2,
        anew,
        lines: lines.iter().map(|line| (*line).to_owned()).collect(),
    };
    console.hear(printed(true, &["of another"]));
    console.hear(printed(true, &["Starting sketch", "a line"]));
    console.hear(printed(false, &["another line"]));
    let screen = console.screen(80, 24);
    assert!(screen.contains("a line") && screen.contains("another line"));
    assert!(!screen.contains("of another"), "{screen}");
    console.press("k");
    assert!(!console.screen(80, 24).contains("another line"));
    console.press("j").press("enter");
    let many: Vec<String> = (1..=60)
        .map(|line| format!("line {line}\u{2502}"))
        .collect();
    let many: Vec<&str> = many.iter().map(String::as_str).collect();
    console.hear(printed(true, &many));
    console.press("page-up").press("page-up");
    assert!(console.screen(80, 24).contains("line 40\u{2502}"));
    console.hear(printed(false, &["the newest"]));
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("line 40\u{2502}") && !screen.contains("line 41"),
        "{screen}"
    );
}

#[test]
fn services_are_told_apart_on_a_narrow_screen() {
    let mut console = starting(Activity::Free, 2);
    let at = |vehicle, port| Instance {
        host: Some(format!("http://127.0.0.1:{port}")),
        ..instance(vehicle, SitlStage::Ready)
    };
    hear(&mut console, vec![at(1, 5700), at(2, 5701)]);
    console.press("G");
    let screen = console.screen(80, 24);
    for host in ["127.0.0.1:5700", "127.0.0.1:5701"] {
        assert!(screen.contains(host), "{screen}");
    }
}

#[test]
fn an_armed_vehicle_is_not_restarted_or_ended_without_a_question() {
    let mut console = ready();
    console.vehicle(fixtures::airborne(1, 0.0, 20.0));
    for (key, line) in [("r", "hangar restart 1"), ("x", "hangar stop 1")] {
        console.press("G").press(key);
        assert!(
            matches!(console.state().overlay(), Some(Overlay::Confirm(_))),
            "{key}"
        );
        console.press("n").give(line);
        assert!(
            matches!(console.state().overlay(), Some(Overlay::Confirm(_))),
            "{line}"
        );
        console.press("n");
    }
    console.give("hangar stop 1").press("y");
    assert_eq!(
        console.effects,
        [Effect::Session(SessionEffect::Process(
            ProcessDeed::Stop,
            1
        ))]
    );
    console.give("hangar stop 2");
    assert_eq!(
        console.effects,
        [Effect::Session(SessionEffect::Process(
            ProcessDeed::Stop,
            2
        ))]
    );
}

#[test]
fn the_mission_does_not_wait_for_one_that_was_ended() {
    let mut console = starting(Activity::Free, 2);
    hear(
        &mut console,
        vec![instance(1, SitlStage::Ready), crashed(2)],
    );
    console.press("j").press("x");
    hear(&mut console, vec![instance(1, SitlStage::Ready)]);
    assert_eq!(console.state().room(), Room::Fly);
}

#[test]
fn lines_about_processes_that_are_not_there_are_explained() {
    let mut console = Console::flying(1);
    console.give("hangar restart 9");
    assert!(console.effects.is_empty());
    let said = console
        .state()
        .message()
        .expect("an answer")
        .text
        .to_string();
    assert_eq!(said, "no process of vehicle 9");
    console.give("hangar");
    assert_eq!(console.state().room(), Room::Hangar);
}

#[test]
fn output_opens_and_scrolls() {
    let mut console = ready();
    let output = (1..=50).map(|line| format!("line {line}")).collect();
    hear(
        &mut console,
        vec![
            Instance {
                output,
                ..crashed(1)
            },
            instance(2, SitlStage::Ready),
        ],
    );
    console.press("G").press("enter");
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("line 50") && !screen.contains("line 20\n"),
        "{screen}"
    );
    console.press("page-up").press("page-up");
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("line 30\n") && !screen.contains("line 31"),
        "{screen}"
    );
    console.press("esc");
    assert_eq!(console.state().room(), Room::Hangar);
    console.press("esc");
    assert_eq!(console.state().room(), Room::Fly);
}

//! Sharing the links with other ground stations, by lines and in the room of the links.

use sortie::app::effect::{Effect, ForwardChange, SessionEffect};
use sortie::app::event::LinkEvent;
use sortie::app::state::{Activity, ForwardSummary, LinkSummary, Overlay};
use sortie::mission::Stake;

use crate::harness::Console;

/// Gives a line; returns the change of the forwards, or the fault.
fn said(console: &mut Console, line: &str) -> Result<ForwardChange, String> {
    console.give(line);
    if let Some(Overlay::Palette(palette)) = console.state().overlay() {
        let fault = palette.fault().expect("it is refused").message.to_string();
        console.press("esc");
        return Err(fault);
    }
    match console.effects.first() {
        Some(Effect::Session(SessionEffect::Forward(change))) => Ok(change.clone()),
        other => panic!("{line}: {other:?}"),
    }
}

fn tcpin() -> ForwardSummary {
    ForwardSummary {
        name: "tcpin:127.0.0.1:5790 read-only rate 2".to_owned(),
        up: true,
        peers: 2,
        received_messages: 17,
        sent_messages: 48_211,
        dropped: 5,
        held_back: 12,
        filtered: 300,
        ..ForwardSummary::default()
    }
}

#[test]
fn a_line_opens_a_forward_and_another_closes_it() {
    let mut console = Console::flying(2);
    let opened = said(
        &mut console,
        "forward add udp:127.0.0.1:14550 except 30 rate 2",
    );
    let Ok(ForwardChange::Open(spec)) = opened else {
        panic!("{opened:?}");
    };
    assert_eq!(
        spec.to_string(),
        "udp:127.0.0.1:14550 except ATTITUDE rate 2"
    );
    let closed = said(&mut console, "forward remove tcpin:127.0.0.1:5790");
    assert!(
        closed
            .expect_err("none is open")
            .contains("no forward to tcpin:127.0.0.1:5790")
    );
    console.hear(LinkEvent::Forwards(vec![tcpin()]));
    let again = said(&mut console, "forward add tcpin:127.0.0.1:5790");
    assert!(again.expect_err("it is open").contains("already shared"));
    let closed = said(&mut console, "forward remove tcpin:127.0.0.1:5790");
    assert_eq!(
        closed,
        Ok(ForwardChange::Close("tcpin:127.0.0.1:5790".to_owned()))
    );
    let faulty = said(&mut console, "forward add udp:127.0.0.1:14550 readonly");
    assert!(
        faulty
            .expect_err("no such word")
            .contains("unknown word `readonly`")
    );
}

#[test]
fn nobody_else_helps_to_fly_a_mission() {
    let mut console = Console::new();
    console.start(Activity::Mission {
        id: "00-first-flight".to_owned(),
        title: "First flight".into(),
        stake: Stake::Graded,
    });
    let open = said(&mut console, "forward add udp:127.0.0.1:14550");
    assert!(open.expect_err("it carries commands").contains("read-only"));
    let closed = said(&mut console, "forward add udp:127.0.0.1:14550 read-only");
    assert!(closed.is_ok(), "{closed:?}");
}

/// A station that listens to a mission gets no answer to its commands; the trainee gets one notice
/// of that.
#[test]
fn a_station_that_sends_something_to_a_mission_is_named_once() {
    let told = |activity: Activity| {
        let mut console = Console::new();
        console.start(activity);
        console.hear(LinkEvent::Summaries(vec![LinkSummary {
            name: "simulator".into(),
            up: true,
            ..LinkSummary::default()
        }]));
        for held_back in [0, 3, 5] {
            let forward = ForwardSummary {
                held_back,
                ..tcpin()
            };
            console.hear(LinkEvent::Forwards(vec![forward]));
        }
        let notices = console.state().notices().lines();
        let said = notices.map(|line| line.notice.text.to_string());
        let listens = said.filter(|text| text.contains("can only listen"));
        let count = listens.inspect(|text| assert!(text.contains("5790:"), "{text}"));
        let count = count.count();
        console.give("links");
        let screen = console.screen(80, 24);
        (count, screen.contains("read-only in a mission"))
    };
    let mission = Activity::Mission {
        id: "00-first-flight".to_owned(),
        title: "First flight".into(),
        stake: Stake::Graded,
    };
    assert_eq!(told(mission), (1, true));
    assert_eq!(told(Activity::Free), (0, false));
}

#[test]
fn the_room_of_the_links_counts_what_each_forward_carries() {
    let mut console = Console::flying(2);
    let link = LinkSummary {
        name: "udpin:0.0.0.0:14550".into(),
        up: true,
        ..LinkSummary::default()
    };
    console.hear(LinkEvent::Summaries(vec![link]));
    let closed = ForwardSummary {
        name: "udp:10.0.0.9:14550".into(),
        error: Some("no route".into()),
        ..ForwardSummary::default()
    };
    console.hear(LinkEvent::Forwards(vec![tcpin(), closed]));
    console.give("forward");
    for (columns, rows) in [(80, 24), (200, 50)] {
        let screen = console.screen(columns, rows);
        for shown in [
            "forwards: other ground stations",
            "48211",
            "312",
            "no route",
        ] {
            assert!(
                screen.contains(shown),
                "{columns}x{rows}, {shown}: {screen}"
            );
        }
    }
}

//! What the host of a crew sees, and answers.

use sortie::class::ConnectionId;
use sortie::crew::protocol::{Confirmed, CrewHello, SaidLine};
use sortie::crew::{Crew, CrewDeed, ProposalChoice};

use super::*;

fn hello(role: Role) -> MemberMessage {
    MemberMessage::Hello(CrewHello {
        protocol: VERSION,
        role: Some(role),
        has: None,
    })
}

/// The host of a flight with anna, a pilot, and olena, who has the role safety.
fn hosting() -> Console {
    let mut console = Console::set_up(|setup| {
        let crew = Crew::new("alpha", Person::named("bohdan"));
        setup.crew = CrewPart::Host(Box::new(crew));
    })
    .in_flight(4);
    for (number, user, role) in [(1, "anna", Role::Pilot), (2, "olena", Role::Safety)] {
        console.hear(CrewEvent::Heard {
            connection: ConnectionId(number),
            user: user.to_owned(),
            message: hello(role),
        });
    }
    console
}

#[test]
fn the_host_sees_who_flies_what() {
    let mut console = hosting();
    console.give("crew offer 1-2 to anna");
    console.hear(CrewEvent::Heard {
        connection: ConnectionId(1),
        user: "anna".to_owned(),
        message: MemberMessage::Act {
            id: 1,
            deed: CrewDeed::Accept(ProposalChoice::default()),
        },
    });
    console.at(5);
    check("crew_host", &console);
}

/// Why the host does not do what a line asks; `None` if it does.
fn fault(console: &Console) -> Option<String> {
    let mut effects = console.effects.iter();
    let answer = effects.find_map(|effect| match effect {
        Effect::Crew(CrewEffect::Tell {
            message: HostMessage::Answer { fault, .. },
            ..
        }) => Some(fault.as_ref().map(|it| it.text().to_string())),
        _ => None,
    });
    answer.expect("the host answers")
}

#[test]
fn a_host_that_was_busy_carries_out_no_line_that_is_old() {
    let mut console = hosting();
    console.at(12);
    let clock = CrewEffect::TellAll(HostMessage::Clock { ms: 12_000 });
    assert!(console.effects.contains(&Effect::Crew(clock)));
    let line = || SaidLine::try_from("4 guided".to_owned()).expect("a line");
    let mut say = |given_ms| {
        console.at(21).hear(CrewEvent::Heard {
            connection: ConnectionId(1),
            user: "anna".to_owned(),
            message: MemberMessage::Say {
                id: 1,
                line: line(),
                confirmed: Confirmed::Nothing,
                given_ms,
            },
        });
        let mut effects = console.effects.iter();
        let is_given = effects.any(|it| matches!(it, Effect::Order { .. }));
        (fault(&console), is_given)
    };
    let late = "the host was busy for 9 s: give it again".to_owned();
    assert_eq!(say(Some(12_000)), (Some(late), false));
    for fresh in [Some(16_000), Some(21_000), Some(30_000), None] {
        assert_eq!(say(fresh), (None, true), "{fresh:?}");
    }
}

#[test]
fn who_did_not_answer_learns_that_the_proposal_has_ended() {
    let mut console = hosting();
    console.hear(CrewEvent::Heard {
        connection: ConnectionId(1),
        user: "anna".to_owned(),
        message: MemberMessage::Act {
            id: 1,
            deed: CrewDeed::Ask { vehicles: vec![3] },
        },
    });
    // Both are heard meanwhile.
    for second in 1..=62 {
        console.at(second);
        for (number, user) in [(1, "anna"), (2, "olena")] {
            console.hear(CrewEvent::Heard {
                connection: ConnectionId(number),
                user: user.to_owned(),
                message: MemberMessage::Here,
            });
        }
    }
    let words = "the proposal of anna has ended without your answer: 3";
    assert!(console.screen(120, 40).contains(words));
}

#[test]
fn a_pilot_reads_who_uses_the_payload_of_a_vehicle() {
    let mut console = hosting();
    console.hear(CrewEvent::Heard {
        connection: ConnectionId(3),
        user: "petro".to_owned(),
        message: hello(Role::Sensors),
    });
    for (id, line) in [(1, "4 mark"), (2, "4 drop")] {
        console.hear(CrewEvent::Heard {
            connection: ConnectionId(3),
            user: "petro".to_owned(),
            message: MemberMessage::Say {
                id,
                line: SaidLine::try_from(line.to_owned()).expect("a line"),
                confirmed: Confirmed::Nothing,
                given_ms: None,
            },
        });
    }
    let screen = console.screen(120, 40);
    assert!(screen.contains("petro commands `drop` to what you fly: 4"));
    assert!(!screen.contains("petro commands `mark`"));
}

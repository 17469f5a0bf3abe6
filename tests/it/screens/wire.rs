//! Power lines on the map.

use sortie::app::event::{SessionEvent, Started};
use sortie::app::room::map::{SketchKind, sketches};
use sortie::app::state::Activity;
use sortie::campaign::Stake;
use sortie::mission::Mission;
use sortie::text::Language;

use crate::harness::Console;

/// The wire is visible from the start; its defects have to be found.
#[test]
fn the_map_shows_the_power_line_without_its_defects() {
    let mission = include_str!("../../../missions/04-line-inspection.toml");
    let mission = Mission::parse(mission).expect("no faults");
    for (language, legend) in [
        (Language::English, "power line, pylons (T)"),
        (Language::Ukrainian, "провід ЛЕП, опори (T)"),
    ] {
        let mut console = Console::in_language(language);
        console.hear(SessionEvent::Started(Box::new(Started {
            activity: Activity::Mission {
                id: mission.id.clone(),
                title: mission.title.clone(),
                stake: Stake::Graded,
            },
            places: mission.places(),
            areas: mission.areas(),
            mission: Some(Box::new(mission.listing())),
            processes: None,
            speedup: 1.0,
            is_again: true,
        })));
        let wires = sketches(console.state()).into_iter();
        let wires = wires.filter(|sketch| sketch.kind == SketchKind::Wire);
        let counts: Vec<usize> = wires.map(|sketch| sketch.points.len()).collect();
        assert_eq!(counts, [4, 1, 1, 1, 1], "the wire and four pylons");
        console.press("M");
        let code = language.code();
        insta::assert_snapshot!(format!("map_wire_{code}_80x24"), console.screen(80, 24));
        console.press("i");
        for (width, height) in [(120, 40), (200, 50)] {
            let screen = console.screen(width, height);
            assert!(screen.contains(legend), "{code}: {screen}");
            insta::assert_snapshot!(format!("map_wire_{code}_{width}x{height}"), screen);
        }
    }
}

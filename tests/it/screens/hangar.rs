//! The room of the vehicles' processes.

use sortie::app::state::{Activity, Instance, SitlStage};
use sortie::text::Language;

use crate::console::hangar::{crashed, hear, instance, start};
use crate::harness::Console;

fn all_stages(language: Language) -> Console {
    let mut console = start(Console::in_language(language), Activity::Free, 8);
    let complete = |vehicle, stage| Instance {
        parameters: [1382, 1382],
        ..instance(vehicle, stage)
    };
    let early = |vehicle, stage| Instance {
        memory_bytes: 0,
        ..instance(vehicle, stage)
    };
    let again = Instance {
        restarts: 2,
        ..instance(4, SitlStage::Heartbeat)
    };
    let far = Instance {
        host: Some("http://lab-2:5700".to_owned()),
        hint: Some("PreArm: Compass not calibrated".to_owned()),
        ..complete(6, SitlStage::Position)
    };
    hear(
        &mut console,
        vec![
            Instance {
                pid: None,
                ..early(1, SitlStage::Queued)
            },
            early(2, SitlStage::Process),
            Instance {
                parameters: [0, 0],
                ..instance(3, SitlStage::Heartbeat)
            },
            again,
            complete(5, SitlStage::Parameters),
            far,
            complete(7, SitlStage::Ready),
            crashed(8),
        ],
    );
    console
}

#[test]
fn the_stages_of_vehicles_that_are_started() {
    for language in Language::ALL {
        let mut console = all_stages(language);
        console.press("end");
        for (width, height) in [(80, 24), (120, 40), (200, 50)] {
            let name = format!("hangar_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
    }
    let mut console = all_stages(Language::English);
    assert!(console.screen(60, 20).contains("80x24"));
    console.press("end").press("enter");
    insta::assert_snapshot!("hangar_output_80x24", console.screen(80, 24));
}

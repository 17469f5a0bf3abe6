//! The room of one vehicle.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use sortie::app::state::{Activity, ReplayView, Room};
use sortie::config::Symbols;
use sortie::dataflash::JoinedLog;
use sortie::plan::Item;
use sortie::text::{Language, Locale};
use sortie::ui::{self, Look, Theme};
use sortie::vehicle::{
    AutopilotVersion, BoardId, FenceArea, FencePlan, FenceShape, FixType, GpsAccuracy, Health, Hud,
    Plan, PlanProgress, RallyPlan, RcChannels, Severity, StatusText, Stored, Target, Transfer,
    Vehicle, Vibration, Wind,
};

use super::map::drawn;
use crate::fixtures;
use crate::harness::Console;

fn at(seconds: u64) -> Duration {
    Duration::from_secs(seconds)
}

const SIZES: [(u16, u16); 3] = [(80, 24), (120, 40), (200, 50)];

/// A plan of a takeoff, a few waypoints and the way home.
fn plan() -> Plan {
    let item = |seq: u16, command: u16, north_m: f64| {
        let (x, y) = fixtures::HOME.moved(north_m, 15.0).to_e7();
        let has_place = command == 16;
        Item {
            command,
            frame: 3,
            auto_continue: true,
            params: [0.0, 0.0, 0.0, f32::NAN],
            x: if has_place { x } else { 0 },
            y: if has_place { y } else { 0 },
            z: if command == 20 {
                f32::NAN
            } else {
                20.0 + f32::from(seq)
            },
        }
    };
    let mut items = vec![item(0, 16, 0.0), item(1, 22, 0.0)];
    items.extend((2..9).map(|seq| item(seq, 16, 40.0 * f64::from(seq))));
    items.push(item(9, 20, 0.0));
    Plan {
        items,
        home_first: true,
    }
}

fn stored<T>(content: T) -> Stored<T> {
    Stored {
        content: Some(Arc::new(content)),
        transfer: Transfer::Done,
    }
}

/// A vehicle that reports everything it can.
fn talkative(altitude_m: f64) -> Vehicle {
    let mut vehicle = fixtures::airborne(3, 60.0, altitude_m);
    let at = Duration::ZERO;
    if let Some(attitude) = &mut vehicle.attitude {
        (attitude.roll_deg, attitude.pitch_deg, attitude.yaw_deg) = (20.0, -8.0, 37.0);
    }
    vehicle.gps_accuracy = Some(GpsAccuracy {
        horizontal_m: 0.9,
        vertical_m: 1.4,
    });
    vehicle.hud = Some(Hud {
        airspeed_m_s: 5.1,
        ground_speed_m_s: 4.8,
        climb_m_s: 0.4,
        altitude_amsl_m: 200.0,
        throttle_percent: 41,
        heading_deg: 37.0,
        at,
    });
    vehicle.vibration = Some(Vibration {
        level_m_s2: [12.0, 35.5, 61.0],
        clipping: Some([0, 3, 140]),
    });
    vehicle.health = Some(Health {
        present: 0x5231_9C2F,
        enabled: 0x5231_FC2F,
        healthy: 0x5221_FC2B,
        load_percent: 21.0,
        at,
    });
    vehicle.target = Some(Target {
        at_point: Some(fixtures::HOME.moved(160.0, 15.0)),
        altitude_m: Some(24.0),
        velocity_m_s: None,
        at,
    });
    vehicle.wind = Some(Wind {
        from_deg: 271.0,
        speed_m_s: 6.3,
    });
    vehicle.rangefinder_m = Some(19.7);
    vehicle.version = Some(AutopilotVersion {
        firmware: (4, 6, 0),
        capabilities: 0,
        board: BoardId::of(0x5EED, &[0; 18]),
        hash: [0; 8],
    });
    add_channels(&mut vehicle);
    add_plans(&mut vehicle);
    vehicle
}

fn add_channels(vehicle: &mut Vehicle) {
    vehicle.servos_us[..4].copy_from_slice(&[1540, 1512, 1497, 1601]);
    vehicle.servos_us[8] = 1900;
    let mut channels_us = [0; 18];
    channels_us[..8].copy_from_slice(&[1500, 1500, 1000, 1500, 1800, 1000, 1000, 1800]);
    vehicle.rc = Some(RcChannels {
        channels_us,
        rssi: Some(212),
    });
}

fn add_plans(vehicle: &mut Vehicle) {
    vehicle.plan = PlanProgress {
        current: 4,
        total: Some(9),
        reached: Some(3),
        ..PlanProgress::default()
    };
    vehicle.plans.plan = stored(plan());
    let circle = FenceArea {
        shape: FenceShape::Circle {
            center: fixtures::HOME,
            radius_m: 300.0,
        },
        inclusion: true,
    };
    vehicle.plans.fence = stored(FencePlan {
        areas: vec![circle],
        ..FencePlan::default()
    });
    vehicle.plans.rally = stored(RallyPlan::default());
    vehicle.texts = ["Mission: 2 WP", "Reached command #2", "Mission: 4 WP"]
        .into_iter()
        .enumerate()
        .map(|(at, text)| StatusText {
            severity: Severity::Info,
            text: text.to_owned(),
            at: Duration::from_secs(20 + at as u64),
        })
        .collect();
}

/// A console in the room of the vehicle, after half a minute of flight.
fn room() -> Console {
    room_of(Console::flying(4))
}

fn room_of(mut console: Console) -> Console {
    console.give("select 3").press("esc");
    for half_seconds in 0..60u64 {
        let climbed = (half_seconds as f64 * 0.5).min(20.0);
        console.vehicle(talkative(climbed));
        let now = Duration::from_millis(500 * half_seconds);
        console.hear(sortie::app::event::Event::Tick { now, wall: now });
    }
    console.press("V");
    assert_eq!(console.state().room(), Room::Vehicle);
    console
}

fn screen(console: &Console, look: &Look, (width, height): (u16, u16)) -> String {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).expect("a test terminal");
    terminal
        .draw(|frame| ui::draw(console.state(), look, frame))
        .expect("a test terminal");
    let buffer = terminal.backend().buffer();
    let rows = buffer.content.chunks(usize::from(width));
    let lines = rows.map(|row| {
        let line: String = row.iter().map(ratatui::buffer::Cell::symbol).collect();
        line.trim_end().to_owned()
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn everything_about_a_vehicle_fits_every_size() {
    let console = room();
    for (width, height) in SIZES {
        insta::assert_snapshot!(
            format!("vehicle_{width}x{height}"),
            console.screen(width, height)
        );
    }
}

#[test]
fn the_log_of_a_vehicle_gives_curves_in_a_replay() {
    let mut view = ReplayView::new("2026-11-20".to_owned(), 1_763_647_402_000_000, at(40));
    view.position.at = at(30);
    let volts = (20..30).map(|second| (second.to_string(), 12.6 - 0.1 * f64::from(second)));
    let volts: BTreeMap<String, f64> = volts.collect();
    let log = serde_json::json!({
        "v": 1, "vehicle": 3, "file": "00000007.BIN", "aligned_by": "gps_time",
        "damage": {"skipped": 0, "cut_off": 0}, "events": [],
        "curves": {"vibration": {"12": 3.0, "13": 41.5, "30": 17.25}, "voltage": volts},
    });
    let log = JoinedLog::read(&log.to_string()).expect("a joined log");
    assert_eq!(JoinedLog::read(&log.to_json()), Ok(log.clone()));
    view.log_curves = Arc::new(BTreeMap::from([(log.vehicle, log.curves)]));
    let mut console = Console::new();
    let addresses = vec!["2026-11-20".to_owned()];
    console.replay(view, Activity::Connected { addresses });
    for id in 1..=4 {
        console.vehicle(fixtures::airborne(id, 60.0, 20.0));
    }
    let console = room_of(console);
    for (width, height) in SIZES {
        insta::assert_snapshot!(
            format!("vehicle_log_{width}x{height}"),
            console.screen(width, height)
        );
    }
}

#[test]
fn a_small_screen_shows_the_rest_on_further_pages() {
    let mut console = room();
    for page in 2..=3 {
        console.press("tab");
        insta::assert_snapshot!(format!("vehicle_page_{page}_80x24"), console.screen(80, 24));
    }
    let first = room().screen(80, 24);
    assert_eq!(console.press("tab").screen(80, 24), first, "round again");
}

#[test]
fn it_reads_in_ukrainian_and_without_colour_or_braille() {
    let console = room();
    let ukrainian = Look {
        locale: Arc::new(Locale::new(Language::Ukrainian)),
        ..Look::default()
    };
    insta::assert_snapshot!("vehicle_uk_120x40", screen(&console, &ukrainian, (120, 40)));
    insta::assert_snapshot!("vehicle_uk_80x24", screen(&console, &ukrainian, (80, 24)));
    let ascii = Look {
        theme: Theme::named("monochrome").expect("a theme"),
        symbols: Symbols::Ascii,
        ..Look::default()
    };
    insta::assert_snapshot!("vehicle_ascii_120x40", screen(&console, &ascii, (120, 40)));
    let block = Look {
        symbols: Symbols::Block,
        ..Look::default()
    };
    insta::assert_snapshot!("vehicle_block_80x24", screen(&console, &block, (80, 24)));
}

#[test]
fn the_window_and_the_vehicle_are_chosen_by_key() {
    let mut console = room();
    for expected in ["last 120 s", "last 600 s", "last 30 s"] {
        assert!(console.press("w").screen(120, 40).contains(expected));
    }
    assert!(console.press("]").screen(80, 24).contains(" 4 copter"));
    assert!(
        console
            .press("[")
            .press("[")
            .screen(80, 24)
            .contains(" 2 copter")
    );
    assert!(console.press("j").screen(80, 24).contains(" 3 copter"));
}

#[test]
fn a_vehicle_of_which_little_is_known_shows_dashes_and_never_nan() {
    let mut console = Console::new();
    console.start(sortie::app::state::Activity::Free);
    console.press("V");
    assert!(console.screen(80, 24).contains("No vehicle"));
    let mut vehicle = Vehicle::new(1, 1);
    console.vehicle(vehicle.clone()).at(1);
    insta::assert_snapshot!("vehicle_unknown_120x40", console.screen(120, 40));
    let mut odd = talkative(f64::NAN);
    vehicle.id = 1;
    odd.id = 1;
    // "(info)" must not count as an infinity.
    odd.texts.clear();
    odd.vibration = Some(Vibration {
        level_m_s2: [f32::NAN, f32::INFINITY, -f32::NAN],
        clipping: Some([0; 3]),
    });
    odd.ekf = odd.ekf.map(|ekf| sortie::vehicle::Ekf {
        velocity_variance: f32::NAN,
        compass_variance: f32::INFINITY,
        ..ekf
    });
    odd.gps_accuracy = Some(GpsAccuracy {
        horizontal_m: f32::NAN,
        vertical_m: f32::INFINITY,
    });
    odd.batteries[0].voltage_v = Some(f32::NAN);
    odd.batteries[0].consumed_mah = Some(f32::NAN);
    odd.wind = Some(Wind {
        from_deg: f32::NAN,
        speed_m_s: f32::NAN,
    });
    let mut still = odd.clone();
    console.vehicle(odd).at(2);
    console.at(3);
    let (width, height) = SIZES[2];
    let screen = console.screen(width, height).to_lowercase();
    assert!(
        !screen.contains("nan") && !screen.contains("inf"),
        "{screen}"
    );
    // An autopilot without an estimate reports calm from the north.
    still.wind = Some(Wind {
        from_deg: 0.0,
        speed_m_s: 0.0,
    });
    console.vehicle(still).at(4);
    console.at(5);
    let screen = console.screen(width, height);
    assert!(screen.contains("not estimated"), "{screen}");
}

#[test]
fn it_is_drawn_at_any_size() {
    let console = room();
    for width in [80, 81, 95, 109, 110, 111, 117, 160, 300] {
        for height in [24, 25, 33, 34, 36, 37, 60, 100] {
            let screen = console.screen(width, height);
            assert!(screen.contains("attitude"), "{width}x{height}");
        }
    }
}

#[test]
fn what_is_not_heard_any_more_is_old_and_neither_good_nor_bad() {
    let mut console = room();
    let mut lost = talkative(20.0);
    lost.link.lost = true;
    lost.link.last_heard = Some(Duration::from_secs(20));
    console.vehicle(lost).at(32);
    let notice = "link lost 12 s ago: last known values";
    for key in ["V", "F"] {
        let screen = console.press(key).screen(120, 40);
        let grades = [" ok", " poor", " BAD"].map(|word| screen.contains(word));
        assert_eq!(grades, [false; 3], "{screen}");
        assert_eq!(screen.matches(notice).count(), 1, "{screen}");
        assert!(screen.contains(" old"), "{screen}");
    }
    let mut terminal = Terminal::new(TestBackend::new(120, 40)).expect("a test terminal");
    let look = Look::default();
    console.press("V");
    terminal
        .draw(|frame| ui::draw(console.state(), &look, frame))
        .expect("a test terminal");
    let muted = look.style(sortie::ui::Role::Muted).fg;
    let live = |at: &&(u16, u16)| terminal.backend().buffer()[**at].fg != muted.expect("a colour");
    let body: Vec<_> = (3..39)
        .flat_map(|y| (0..120).map(move |x| (x, y)))
        .collect();
    assert_eq!(body.iter().find(live), None, "a value looks live");
}

#[test]
fn the_flight_room_and_this_one_judge_the_filter_alike() {
    for (ratio, word) in [(0.1, "ok"), (0.7, "poor"), (f32::NAN, "BAD"), (-1.0, "BAD")] {
        let mut console = room();
        let mut vehicle = talkative(20.0);
        vehicle.ekf = vehicle.ekf.map(|ekf| sortie::vehicle::Ekf {
            velocity_variance: ratio,
            ..ekf
        });
        console.vehicle(vehicle);
        let here = console.screen(120, 40);
        let row = here.lines().find(|line| line.contains("position known"));
        assert!(row.is_some_and(|row| row.contains(word)), "{here}");
        let there = console.press("F").screen(120, 40);
        assert!(there.contains(&format!("EKF      {word}  vel")), "{there}");
    }
}

#[test]
fn a_disarmed_vehicle_says_for_how_long_it_was_armed_last() {
    let mut console = room();
    assert!(console.screen(120, 40).contains("armed for   00:30"));
    let mut vehicle = talkative(0.0);
    vehicle.heartbeat = fixtures::parked(3).heartbeat;
    console.vehicle(vehicle.clone()).at(31);
    assert!(console.screen(120, 40).contains("last armed  for 00:30"));
    vehicle.link.reboots = 1;
    console.vehicle(vehicle).at(32);
    assert!(console.screen(120, 40).contains("armed for   -"));
}

#[test]
fn absurd_figures_stay_short() {
    let mut console = room();
    let mut vehicle = talkative(1e38);
    vehicle.ekf = vehicle.ekf.map(|ekf| sortie::vehicle::Ekf {
        velocity_variance: 1e38,
        ..ekf
    });
    vehicle.vibration = Some(Vibration {
        level_m_s2: [1e38; 3],
        clipping: Some([0; 3]),
    });
    console.vehicle(vehicle).at(31);
    for key in ["V", "F"] {
        let screen = console.press(key).screen(120, 40);
        assert!(
            screen.contains("1e38") && !screen.contains("00000000"),
            "{screen}"
        );
    }
}

/// `SYS_STATUS` calls a receiver without a fix healthy.
#[test]
fn a_healthy_receiver_without_a_fix_is_shown_as_poor() {
    let mut vehicle = talkative(24.0);
    vehicle.gps.as_mut().expect("a report").fix = FixType::NoFix;
    if let Some(health) = &mut vehicle.health {
        health.healthy |= 1 << 5;
    }
    for (language, words) in [
        (Language::English, "poor  GPS (no fix)"),
        (Language::Ukrainian, "слаб. GPS (фікс: немає)"),
    ] {
        let mut console = Console::flying(0);
        console.vehicle(vehicle.clone()).press("V");
        let text = drawn(&console, Symbols::Braille, language, (120, 40));
        assert!(text.contains(words), "{text}");
    }
}

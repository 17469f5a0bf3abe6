//! Vehicles, missions and results as test data.

use std::time::Duration;

use sortie::geo::LatLon;
use sortie::language::Findings;
use sortie::mission::{
    Cell, ClueProgress, Listing, Mission, ObjectiveProgress, ObjectiveState, Phase, Pledge,
    Progress, Reading,
};
use sortie::record::InstructorPart;
use sortie::scoring::{
    Component, ComponentReport, EventKind, EventReport, FlightBackend, FlightOutcome, FlownBy,
    MissionFile, ObjectiveReport, Report, ScoreGrade, SwarmFigures, TruthReport, WorkloadReport,
};
use sortie::vehicle::{
    Attitude, Battery, Ekf, EkfFlags, FixType, GlobalPosition, Gps, Health, Heartbeat, LandedState,
    LinkQuality, Place, SystemStatus, Vehicle, VehicleClass,
};

pub mod career;

pub const HOME: LatLon = LatLon::new(50.4501, 30.5234);
pub const BRIEF: &str = "A tank at the yard has leaked. Before anybody walks in, the air has to be \
                         measured over the yard.\n\nFly one drone over every cell of the grid, stay long \
                         enough for the sensor to settle, and bring it back to its pad.";

/// A copter on the ground that is ready to arm.
pub fn parked(id: u16) -> Vehicle {
    let mut vehicle = Vehicle::new((id % 250) as u8, 1);
    vehicle.id = id;
    let at = Duration::ZERO;
    let pad = HOME.moved(0.0, 5.0 * f64::from(id));
    vehicle.heartbeat = Some(Heartbeat {
        mav_type: 2,
        autopilot: 3,
        class: VehicleClass::Copter,
        mode: VehicleClass::Copter.mode("STABILIZE").expect("a mode"),
        armed: false,
        status: SystemStatus::Standby,
        at,
    });
    vehicle.global = Some(GlobalPosition {
        at_point: pad,
        altitude_amsl_m: 180.0,
        altitude_m: 0.0,
        north_m_s: 0.0,
        east_m_s: 0.0,
        down_m_s: 0.0,
        heading_deg: Some(0.0),
        at,
    });
    vehicle.home = Some(Place {
        at_point: pad,
        altitude_amsl_m: 180.0,
    });
    vehicle.landed = LandedState::OnGround;
    add_instruments(&mut vehicle, at);
    vehicle.link = LinkQuality {
        last_heard: Some(at),
        received: 990,
        missing: 10,
        round_trip: Some(Duration::from_millis(3)),
        ..LinkQuality::default()
    };
    vehicle
}

/// Adds attitude, GPS, health, battery and filter of a healthy vehicle.
fn add_instruments(vehicle: &mut Vehicle, at: Duration) {
    vehicle.attitude = Some(Attitude {
        roll_deg: 0.2,
        pitch_deg: -0.4,
        yaw_deg: 90.0,
        at,
    });
    vehicle.gps = Some(Gps {
        fix: FixType::RtkFixed,
        satellites: Some(14),
        hdop: Some(0.8),
        at,
    });
    vehicle.health = Some(Health {
        present: 0,
        enabled: 0,
        healthy: Health::PREARM,
        load_percent: 21.0,
        at,
    });
    vehicle.batteries = vec![Battery {
        id: 0,
        voltage_v: Some(16.6),
        current_a: Some(0.4),
        consumed_mah: Some(12.0),
        consumed_wh: None,
        remaining_percent: Some(99),
        at,
    }];
    vehicle.ekf = Some(Ekf {
        flags: EkfFlags(0x33f),
        velocity_variance: 0.02,
        position_horizontal_variance: 0.03,
        position_vertical_variance: 0.01,
        compass_variance: 0.04,
        at,
    });
}

/// A copter in the air in GUIDED.
pub fn airborne(id: u16, north_m: f64, altitude_m: f64) -> Vehicle {
    let mut vehicle = parked(id);
    vehicle.landed = LandedState::InAir;
    if let Some(heartbeat) = &mut vehicle.heartbeat {
        heartbeat.armed = true;
        heartbeat.mode = VehicleClass::Copter.mode("GUIDED").expect("a mode");
        heartbeat.status = SystemStatus::Active;
    }
    if let Some(global) = &mut vehicle.global {
        global.at_point = global.at_point.moved(north_m, 0.0);
        global.altitude_m = altitude_m;
        global.altitude_amsl_m += altitude_m;
        global.north_m_s = 4.8;
    }
    if let Some(battery) = vehicle.batteries.first_mut() {
        battery.remaining_percent = Some(71);
        battery.voltage_v = Some(15.4);
        battery.current_a = Some(14.2);
        battery.consumed_mah = Some(1450.0);
    }
    vehicle
}

/// A boat under way in AUTO, or a rover that stands in HOLD, both on a road or river above home.
pub fn on_surface(id: u16, is_boat: bool) -> Vehicle {
    let mut vehicle = airborne(id, 30.0, 12.0);
    vehicle.landed = LandedState::Undefined;
    if let Some(heartbeat) = &mut vehicle.heartbeat {
        heartbeat.class = VehicleClass::Rover;
        (heartbeat.mav_type, heartbeat.mode) = if is_boat {
            (11, VehicleClass::Rover.mode("AUTO").expect("a mode"))
        } else {
            (10, VehicleClass::Rover.mode("HOLD").expect("a mode"))
        };
    }
    if let Some(global) = &mut vehicle.global
        && !is_boat
    {
        global.north_m_s = 0.0;
    }
    vehicle
}

/// The shipped mission, under another name.
pub fn listing() -> Listing {
    let source = include_str!("../../missions/01-air-sample.toml");
    Listing {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        brief: BRIEF.into(),
        ..Mission::parse(source).expect("it is good").listing()
    }
}

/// A mission under way: nine cells, four of them sampled.
pub fn progress() -> Progress {
    let objective = |title: &str, state, detail: &str, fraction| ObjectiveProgress {
        title: title.into(),
        state,
        detail: detail.into(),
        fraction,
    };
    let cells = (0..9).map(|at| Cell {
        name: format!("{}{}", ["A", "B", "C"][at / 3], at % 3 + 1),
        centre: HOME.moved(20.0 + 10.0 * (at / 3) as f64, 10.0 * (at % 3) as f64),
        side_m: 10.0,
        sampled: at < 4,
        value: (at < 5).then_some(3.0 + 17.25 * at as f64),
    });
    Progress {
        title: "Air sample at the yard".into(),
        elapsed: Duration::from_secs(192),
        limit: Duration::from_secs(600),
        score_so_far: Some(412),
        objectives: vec![
            objective(
                "Measure the air over the yard",
                ObjectiveState::Open,
                "4/9 cells",
                0.44,
            ),
            objective(
                "Find the highest concentration",
                ObjectiveState::Met,
                "B2",
                1.0,
            ),
            objective("Land on the pad", ObjectiveState::Open, "", 0.0),
        ],
        loads: Vec::new(),
        mapped: Vec::new(),
        swept: Vec::new(),
        readings: vec![Reading {
            vehicle: 1,
            sensor: "co".into(),
            value: 37.52,
            unit: "ppm",
        }],
        hint: Some("hover 3 s over a cell before you fly on".into()),
        lesson: None,
        phase: Phase::Air,
        feedback: None,
        clues: ClueProgress {
            is_news: false,
            given: Vec::new(),
            next: None,
            factor: 1.0,
        },
        ends_itself: false,
        can_pledge: false,
        answered_question: None,
        swarm: SwarmFigures::default(),
        findings: Findings::default(),
        places: std::collections::BTreeMap::new(),
        can_confirm: true,
        contacts: Vec::new(),
        injected: Vec::new(),
        expected: None,
        injects: Vec::new(),
        marks: Vec::new(),
        pledge: Pledge::default(),
        cells: cells.collect(),
        areas: Vec::new(),
        movers: Vec::new(),
        alerts: Vec::new(),
        margins_db: std::collections::BTreeMap::new(),
    }
}

/// The report of a finished mission.
pub fn report() -> Report {
    Report {
        mission: "m01".to_owned(),
        revision: 1,
        seed: 1,
        backend: FlightBackend::Embedded,
        flown_by: Some(FlownBy::Hand),
        crew: Vec::new(),
        mission_file: Some(MissionFile::Course),
        given_up: false,
        passed: true,
        score: 837,
        medal: None,
        sim_time_s: 312.4,
        objectives: vec![ObjectiveReport {
            id: "measure".to_owned(),
            title: "Measure the air over the yard".into(),
            mandatory: true,
            met: true,
            result: "9/9 cells".into(),
            target: "9 cells".into(),
            points: 60.0,
            points_max: 60.0,
        }],
        components: vec![ComponentReport {
            component: Component::Objective,
            weight: 0.35,
            value: 1.0,
            points: 350.0,
            moved_by: "all objectives met".into(),
        }],
        ledger: Vec::new(),
        events: vec![EventReport {
            at_s: 120.0,
            kind: EventKind::Objective,
            vehicle: Some(1),
            text: "cell A1 sampled".into(),
            about: None,
        }],
        title: "Air sample at the yard".into(),
        outcome: FlightOutcome::Passed,
        grade: ScoreGrade::B,
        vehicles: 1,
        time_limit_s: 600.0,
        par_time_s: 300.0,
        energy_wh: Some(21.0),
        par_energy_wh: 25.0,
        gold_missing: Vec::new(),
        improvements: Vec::new(),
        subtotal: 350.0,
        hint_factor: 1.0,
        attempt: 1,
        hints: Vec::new(),
        prediction: None,
        goal: None,
        alerts: Vec::new(),
        usage: Vec::new(),
        swarm: SwarmFigures::default(),
        workload: WorkloadReport::default(),
        truth: TruthReport::default(),
        instructor: InstructorPart::default(),
        drill: None,
        tries: Vec::new(),
        wall_time_s: None,
    }
}

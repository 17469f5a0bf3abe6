//! Ground robots and boats: figures beside published ones, and what each choice changes.

use super::*;
use crate::workshop::{DriveFigures, Measure, Sheet};

fn figures(ids: &str) -> DriveFigures {
    let built = design("driven", ids);
    built.drive_figures(Air::default()).expect("complete")
}

/// A skid-steered robot, and parts that everybody has.
const ROBOT: &str = "ch_930k gm_200 b6s22000 fc_h7 gps_m8n pm_hv r_sik915";
const BOAT: &str = "hl_120c th_51 b4s10000 fc_h7 gps_m8n pm_02 r_sik915";

/// Top speeds that makers publish, in m/s: those of the vehicles named in the catalogue, and the thrust of thrusters at rest
/// from their data sheets, in newtons.
#[test]
fn published_top_speeds_come_out_within_15_percent() {
    for (name, ids, published) in [
        ("Scout 2.0", ROBOT, 1.5),
        ("Jackal", "ch_508k gm_60 b6s10000", 2.0),
        ("BlueBoat", BOAT, 3.0),
        ("Otter", "hl_200c th_245 b4s10000 b4s10000 b4s10000", 3.0),
    ] {
        let found = figures(ids).top_speed_m_s;
        let error = found / published - 1.0;
        assert!(error.abs() < 0.15, "{name}: {found:.2} m/s");
    }
}

#[test]
fn thrusters_push_as_their_data_sheets_say() {
    for (ids, volts, published_n) in [
        ("hl_120c th_51 b4s10000 b4s10000", 15.0, 2.0 * 48.0),
        ("hl_120c th_158 b6s22000", 22.8, 2.0 * 148.0),
    ] {
        let found_n = figures(ids).pull_n;
        let error = found_n / published_n - 1.0;
        assert!(error.abs() < 0.1, "{ids} at {volts} V: {found_n:.0} N");
    }
}

#[test]
fn a_robot_is_computed_as_by_hand() {
    let robot = design("robot", ROBOT);
    let found = figures(ROBOT);
    let mass_kg = (33_000.0 + 4.0 * 3400.0 + 2650.0 + 8.0 + 32.0 + 65.0 + 15.0 + 60.0) * 1.03e-3;
    assert!((robot.mass_kg() - mass_kg).abs() < 1e-9, "{mass_kg}");
    // 0.06 of the weight, and the air at 0.97 m/s.
    let rolling_n = 0.06 * mass_kg * 9.80665;
    let air_n = 0.5 * 1.225 * 0.3 * found.cruise_speed_m_s * found.cruise_speed_m_s;
    assert!((found.resistance_n - rolling_n - air_n).abs() < 0.01);
    let turns_s = found.cruise_speed_m_s / 0.165;
    let volt_s = 60.0 / std::f64::consts::TAU / 4.2;
    let amperes = found.resistance_n / 4.0 * 0.165 / (0.75 * volt_s) + 0.8;
    let volts = 0.35 * amperes + turns_s * volt_s;
    let power_w = 4.0 * volts * amperes + robot.electronics_w();
    assert!((found.cruise_power_w - power_w).abs() < 0.5, "{power_w}");
    // 80 % of 22 Ah at 23.3 V, the mean of the discharge curve less the drop under load.
    let time_s = 0.8 * 22.0 * 23.3 * 3600.0 / power_w;
    assert!((found.drive_time_s / time_s - 1.0).abs() < 0.03, "{time_s}");
    assert!((found.range_m - found.drive_time_s * found.cruise_speed_m_s).abs() < 1e-6);
}

#[test]
fn every_choice_changes_the_figures_in_its_direction() {
    let base = figures(ROBOT);
    let two = figures(&format!("{ROBOT} b6s22000"));
    assert!(two.mass_kg > base.mass_kg && two.drive_time_s > 1.9 * base.drive_time_s);
    let laden = figures(&format!("{ROBOT} s_flail"));
    assert!(laden.resistance_n > base.resistance_n && laden.drive_time_s < base.drive_time_s);
    assert!(laden.spare_kg < base.spare_kg - 16.0);
    let smaller = figures(&ROBOT.replace("gm_200", "gm_60"));
    assert!(smaller.pull_n < base.pull_n && smaller.top_speed_m_s > base.top_speed_m_s);
    assert!(base.turning_radius_m < 1e-9 && base.slope_deg.is_some());
    let steered = figures("ch_980s gm_hub350 b12s16000");
    assert!(steered.turning_radius_m > 1.0);
    let (boat, laden) = (
        figures(BOAT),
        figures(&format!("{BOAT} s_drop s_med s_med s_med s_med")),
    );
    assert!(laden.top_speed_m_s < boat.top_speed_m_s && boat.slope_deg.is_none());
}

#[test]
fn faults_of_a_robot_or_boat_are_told_with_their_reason() {
    let rest = "fc_h7 gps_m8n pm_hv r_sik915";
    for (drive, kind) in [
        ("ch_410k gm_37 b3s5000 s_flail", FindingKind::Overload),
        ("ch_930k gm_200 b3s5000", FindingKind::MotorCells),
        ("ch_930k gm_37 b3s5000", FindingKind::Slope),
        ("hl_120c th_158 l6s4p_m50lt", FindingKind::PeakCurrent),
        ("hl_120c b4s10000", FindingKind::Missing),
        ("hl_120c th_51 b4s10000 s_flail", FindingKind::Unfit),
        ("hl_120c th_51 b4s10000 p10x4.5", FindingKind::Unfit),
        (
            "fr_450q m2212_920 p10x4.5p b3s5000 e30opto s_flail",
            FindingKind::Unfit,
        ),
    ] {
        let built = design("driven", &format!("{drive} {rest}"));
        let found = built.findings(Air::default());
        let kinds: Vec<FindingKind> = found.iter().map(|it| it.kind).collect();
        assert!(kinds.contains(&kind), "{drive}: {kinds:?}");
    }
    for ids in [ROBOT, BOAT] {
        let built = design("driven", ids);
        assert_eq!(built.findings(Air::default()), [], "{ids}");
    }
}

#[test]
fn the_frame_says_the_kind_and_takes_the_parts_of_another_kind_off() {
    let drone = design("drone", "fr_450q m2212_920 p10x4.5p e30opto b3s5000 s_voc");
    assert_eq!(drone.kind(), DesignKind::Drone);
    let robot = drone.with(part("ch_410k").expect("known"));
    assert_eq!(robot.kind(), DesignKind::Robot);
    let left: Vec<&str> = robot.pieces().map(|(part, _)| part.id).collect();
    assert_eq!(left, ["ch_410k", "b3s5000", "s_voc"]);
    assert_eq!(robot.vehicle_kind().name(), "rover-skid");
    let boat = robot.with(part("hl_090m").expect("known"));
    assert_eq!(
        (boat.kind(), boat.vehicle_kind().name()),
        (DesignKind::Boat, "motorboat")
    );
    assert_eq!(Design::from_toml(&robot.to_toml()), Ok(robot));
}

#[test]
fn every_kind_has_parts_for_all_its_slots_and_shows_what_it_has() {
    for kind in DesignKind::ALL {
        for &slot in kind.slots() {
            let fitting = parts().filter(|part| part.slot() == slot && part.fits(kind));
            assert!(fitting.count() > 1, "{kind:?} {slot:?}");
        }
    }
    for ids in [ROBOT, BOAT] {
        let sheet = Sheet::of(&design("driven", ids), Air::default());
        let shown = sheet.measures().iter().filter(|it| it.of(&sheet).is_some());
        assert_eq!(shown.count(), sheet.measures().len(), "{ids}");
        assert!(Measure::HoverTime.of(&sheet).is_none());
    }
}

//! The formulas, compared with real drones.

use crate::workshop::Air;
use crate::workshop::design::Drive;
use crate::workshop::drive::VOLTAGE_SHARE;
use crate::workshop::pack::Pack;
use crate::workshop::part::{Battery, Chemistry, Esc, Frame, Motor, Propeller};

/// A drone on the market, with figures from its maker or its users.
struct Known {
    name: &'static str,
    mass_kg: f64,
    motors: u8,
    propeller: (f64, f64, f64),
    motor: (f64, f64, f64),
    /// The battery: cells, ampere hours, C rating.
    battery: (u8, f64, f64),
    electronics_w: f64,
    /// The share of the charge used in the stated time, and the range of that time in minutes.
    share: f64,
    minutes: (f64, f64),
}

/// Drones with stated times: those of the F450 by users, of the X500 by its maker in two public notes, of the others by
/// their makers. Motors without data sheets are estimated, so these rows test the method.
const KNOWN: [Known; 6] = [
    Known {
        name: "F450 with a gimbal",
        mass_kg: 1.45,
        motors: 4,
        propeller: (10.0, 0.105, 0.045),
        motor: (920.0, 0.21, 0.45),
        battery: (3, 5.0, 30.0),
        electronics_w: 8.0,
        share: 0.8,
        minutes: (12.0, 15.0),
    },
    Known {
        name: "IRIS+",
        mass_kg: 1.282,
        motors: 4,
        propeller: (9.5, 0.112, 0.0425),
        motor: (920.0, 0.20, 0.45),
        battery: (3, 5.1, 16.0),
        electronics_w: 5.0,
        share: 0.8,
        minutes: (16.0, 22.0),
    },
    Known {
        name: "X500 V2",
        mass_kg: 1.75,
        motors: 4,
        propeller: (10.0, 0.1075, 0.0392),
        motor: (920.0, 0.16, 0.5),
        battery: (4, 5.0, 30.0),
        electronics_w: 6.0,
        share: 0.9,
        minutes: (16.2, 19.8),
    },
    Known {
        name: "Phantom 4 Pro",
        mass_kg: 1.388,
        motors: 4,
        propeller: (9.4, 0.118, 0.046),
        motor: (800.0, 0.15, 0.4),
        battery: (4, 5.87, 15.0),
        electronics_w: 12.0,
        share: 1.0,
        minutes: (27.0, 33.0),
    },
    Known {
        name: "S1000, 9.5 kg",
        mass_kg: 9.5,
        motors: 8,
        propeller: (15.0, 0.08, 0.0258),
        motor: (400.0, 0.116, 0.6),
        battery: (6, 15.0, 15.0),
        electronics_w: 20.0,
        share: 0.9,
        minutes: (13.5, 16.5),
    },
    Known {
        name: "M600 Pro, 15.5 kg",
        mass_kg: 15.5,
        motors: 6,
        propeller: (21.0, 0.07, 0.0215),
        motor: (130.0, 0.15, 0.5),
        battery: (12, 13.5, 15.0),
        electronics_w: 20.0,
        share: 0.9,
        minutes: (14.4, 17.6),
    },
];

#[test]
fn real_machines_hover_as_long_as_stated_within_a_tenth() {
    for known in KNOWN {
        let minutes = hover_minutes(&known);
        let (least, most) = known.minutes;
        assert!(
            (least..=most).contains(&minutes),
            "{}: {minutes:.1} min",
            known.name
        );
    }
}

fn hover_minutes(known: &Known) -> f64 {
    let (diameter_in, thrust, power) = known.propeller;
    let (kv_rpm_v, resistance_ohm, idle_current_a) = known.motor;
    let (cells, capacity_ah, c_rate) = known.battery;
    let frame = Frame {
        motors: known.motors,
        wheelbase_m: 1.0,
        largest_propeller_in: 30.0,
        drag_area_m2: 0.05,
        download: 0.06,
    };
    let motor = Motor {
        kv_rpm_v,
        resistance_ohm,
        idle_current_a,
        max_current_a: 50.0,
        max_power_w: 2000.0,
        fewest_cells: 1,
        most_cells: 14,
    };
    let propeller = Propeller {
        diameter_in,
        pitch_in: 5.0,
        thrust,
        power,
        max_rpm: 20_000.0,
    };
    let esc = Esc {
        max_current_a: 60.0,
        max_cells: 14,
        efficiency: 0.9,
    };
    let cell_resistance_mohm = 110.0 / (capacity_ah * c_rate.sqrt());
    let battery = Battery {
        chemistry: Chemistry::Polymer,
        cells,
        capacity_ah,
        c_rate,
        cell_resistance_mohm,
    };
    let drive = Drive {
        frame: &frame,
        motor: &motor,
        propeller: &propeller,
        esc: &esc,
        battery: &battery,
        packs: 1,
    };
    let pack = Pack::of(&drive, 25.0);
    let hover = drive.hovering(known.mass_kg, Air::default().density());
    let power_w = drive.hover_power_w(&hover, known.electronics_w);
    pack.lasts(power_w, known.share, hover.volts / VOLTAGE_SHARE)
        .0
        / 60.0
}

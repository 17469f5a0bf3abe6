//! What a drone carries besides what makes it fly: electronics, radios, sensors, things to drop.
//!
//! Masses, powers and prices are those of typical parts of late 2025. Prices above 500 credits grow more slowly than
//! real ones, with the power 0.55, so that the dearest sensor can be earned.

use crate::workshop::part::{Part, PowerModule, Radio, Spec};

const fn equipment(id: &'static str, spec: Spec, power_w: f64, price: (f64, u32)) -> Part {
    Part {
        power_w,
        ..Part::new(id, price, spec)
    }
}

const fn power_module(
    id: &'static str,
    (max_cells, max_current_a): (u8, f64),
    power_w: f64,
    price: (f64, u32),
) -> Part {
    let spec = PowerModule {
        max_cells,
        max_current_a,
    };
    equipment(id, Spec::Power(spec), power_w, price)
}

const fn radio(
    id: &'static str,
    (power_dbm, frequency_mhz, sensitivity_dbm): (f64, f64, f64),
    (air_dbi, ground_dbi, losses_db): (f64, f64, f64),
    power_w: f64,
    price: (f64, u32),
) -> Part {
    let spec = Radio {
        power_dbm,
        frequency_mhz,
        sensitivity_dbm,
        air_dbi,
        ground_dbi,
        losses_db,
        relays: false,
    };
    equipment(id, Spec::Radio(spec), power_w, price)
}

/// Each of them passes on what others of its kind send.
const fn mesh(part: Part) -> Part {
    match part.spec {
        Spec::Radio(radio) => Part {
            spec: Spec::Radio(Radio {
                relays: true,
                ..radio
            }),
            ..part
        },
        _ => part,
    }
}

/// Watts; grams and credits.
pub(super) static AVIONICS: [Part; 9] = [
    equipment("fc_h7", Spec::Autopilot, 0.6, (8.0, 75)),
    equipment("fc_px6c", Spec::Autopilot, 2.0, (35.0, 215)),
    equipment("fc_cube", Spec::Autopilot, 3.0, (73.0, 380)),
    equipment("gps_m8n", Spec::Navigation, 0.4, (32.0, 45)),
    equipment("gps_m10", Spec::Navigation, 0.3, (25.0, 60)),
    equipment("gps_f9p", Spec::Navigation, 1.0, (58.0, 320)),
    equipment("gps_crpa", Spec::Navigation, 3.5, (180.0, 1185)),
    power_module("pm_02", (6, 60.0), 0.3, (20.0, 30)),
    power_module("pm_hv", (14, 200.0), 0.6, (65.0, 95)),
];

/// dBm sent, MHz, dBm needed; dBi in the air and on the ground, dB lost; watts; grams and credits.
pub(super) static RADIOS: [Part; 8] = [
    radio(
        "r_wifi24",
        (20.0, 2437.0, -88.0),
        (2.0, 5.0, 6.0),
        1.2,
        (10.0, 20),
    ),
    radio(
        "r_sik433",
        (20.0, 433.0, -112.0),
        (2.0, 2.0, 12.0),
        0.6,
        (15.0, 55),
    ),
    radio(
        "r_sik915",
        (20.0, 915.0, -112.0),
        (2.0, 2.0, 12.0),
        0.6,
        (15.0, 55),
    ),
    radio(
        "r_rfd900",
        (30.0, 915.0, -112.0),
        (3.0, 2.0, 8.0),
        4.0,
        (15.0, 130),
    ),
    radio(
        "r_elrs24",
        (20.0, 2440.0, -108.0),
        (2.0, 5.0, 8.0),
        0.5,
        (5.0, 35),
    ),
    radio(
        "r_lora868",
        (22.0, 868.0, -126.0),
        (2.0, 2.0, 10.0),
        0.4,
        (8.0, 25),
    ),
    mesh(radio(
        "r_mesh24",
        (30.0, 2450.0, -96.0),
        (3.0, 5.0, 6.0),
        6.0,
        (60.0, 1010),
    )),
    radio(
        "r_lte",
        (23.0, 800.0, -110.0),
        (2.0, 2.0, 0.0),
        3.0,
        (40.0, 150),
    ),
];

/// Watts; grams and credits.
///
/// The sprayer's tank holds what it gives in 15 seconds: a kilogram of liquid beside a pump with its hose.
pub(super) static PAYLOADS: [Part; 21] = [
    equipment("s_rgb", Spec::Payload, 3.0, (60.0, 120)),
    equipment("s_rgbg", Spec::Payload, 5.0, (95.0, 300)),
    equipment("s_zoom", Spec::Payload, 12.0, (380.0, 640)),
    equipment("s_th160", Spec::Payload, 0.5, (12.0, 230)),
    equipment("s_th320", Spec::Payload, 1.5, (60.0, 915)),
    equipment("s_thdual", Spec::Payload, 9.0, (180.0, 1390)),
    equipment("s_pm25", Spec::Payload, 0.3, (26.0, 45)),
    equipment("s_gas4", Spec::Payload, 0.6, (120.0, 480)),
    equipment("s_tdlas", Spec::Payload, 6.0, (350.0, 2870)),
    equipment("s_voc", Spec::Payload, 0.4, (60.0, 580)),
    equipment("s_mag", Spec::Payload, 1.0, (150.0, 915)),
    equipment("s_md", Spec::Payload, 8.0, (900.0, 1210)),
    equipment("s_gpr", Spec::Payload, 8.0, (1500.0, 3245)),
    equipment("s_geiger", Spec::Payload, 0.3, (50.0, 80)),
    equipment("s_csi", Spec::Payload, 1.0, (300.0, 1675)),
    equipment("s_drop", Spec::Payload, 0.5, (60.0, 45)),
    equipment("s_ball", Spec::Load, 0.0, (500.0, 60)),
    equipment("s_med", Spec::Load, 0.0, (450.0, 25)),
    equipment("s_node", Spec::Load, 0.0, (90.0, 60)),
    equipment("s_spray", Spec::Payload, 2.0, (1450.0, 120)),
    equipment("s_relay", Spec::Payload, 4.0, (150.0, 400)),
];

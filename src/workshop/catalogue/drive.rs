//! What makes a drone fly: frames, motors, propellers, batteries, speed controllers.
//!
//! Masses, resistances and prices are those of typical parts of late 2025, from data sheets and shops, or estimated for
//! their class. Propellers have UIUC's and APC's static figures, brought down to what independent tests find (7 % less
//! thrust, 5 % less power for APC's computed ones; 7.5 % more power for makers' tables). The resistance of a lithium polymer
//! cell is `0.110 / (Ah sqrt(C))` ohms where its maker gives none.

use crate::workshop::part::{Battery, Chemistry, Esc, Frame, Motor, Part, Propeller, Spec};

const fn frame(
    id: &'static str,
    motors: u8,
    (wheelbase_m, largest_propeller_in): (f64, f64),
    (drag_area_m2, download): (f64, f64),
    price: (f64, u32),
) -> Part {
    let spec = Frame {
        motors,
        wheelbase_m,
        largest_propeller_in,
        drag_area_m2,
        download,
    };
    Part::new(id, price, Spec::Frame(spec))
}

const fn motor(
    id: &'static str,
    (kv_rpm_v, resistance_ohm, idle_current_a): (f64, f64, f64),
    (max_current_a, max_power_w): (f64, f64),
    cells: (u8, u8),
    price: (f64, u32),
) -> Part {
    let spec = Motor {
        kv_rpm_v,
        resistance_ohm,
        idle_current_a,
        max_current_a,
        max_power_w,
        cells,
    };
    Part::new(id, price, Spec::Motor(spec))
}

const fn propeller(
    id: &'static str,
    (diameter_in, pitch_in): (f64, f64),
    (thrust, power): (f64, f64),
    max_rpm: f64,
    price: (f64, u32),
) -> Part {
    let spec = Propeller {
        diameter_in,
        pitch_in,
        thrust,
        power,
        max_rpm,
    };
    Part::new(id, price, Spec::Propeller(spec))
}

const fn lipo(
    id: &'static str,
    (cells, capacity_ah): (u8, f64),
    c_rate: f64,
    cell_mohm: f64,
    price: (f64, u32),
) -> Part {
    battery(
        id,
        Chemistry::Polymer,
        (cells, capacity_ah),
        (c_rate, cell_mohm),
        price,
    )
}

const fn ion(
    id: &'static str,
    (cells, capacity_ah): (u8, f64),
    c_rate: f64,
    cell_mohm: f64,
    price: (f64, u32),
) -> Part {
    battery(
        id,
        Chemistry::Ion,
        (cells, capacity_ah),
        (c_rate, cell_mohm),
        price,
    )
}

const fn battery(
    id: &'static str,
    chemistry: Chemistry,
    (cells, capacity_ah): (u8, f64),
    (c_rate, cell_mohm): (f64, f64),
    price: (f64, u32),
) -> Part {
    let spec = Battery {
        chemistry,
        cells,
        capacity_ah,
        c_rate,
        cell_resistance_ohm: cell_mohm * 1e-3,
    };
    Part::new(id, price, Spec::Battery(spec))
}

const fn esc(
    id: &'static str,
    max_current_a: f64,
    max_cells: u8,
    efficiency: f64,
    price: (f64, u32),
) -> Part {
    let spec = Esc {
        max_current_a,
        max_cells,
        efficiency,
    };
    Part::new(id, price, Spec::Esc(spec))
}

/// Motors; metres between opposite ones, inches of the largest propeller; square metres of drag, share of download;
/// grams and credits.
pub(super) static FRAMES: [Part; 13] = [
    frame("fr_5q_226", 4, (0.226, 5.1), (0.012, 0.08), (100.0, 35)),
    frame("fr_7q_315", 4, (0.315, 7.0), (0.016, 0.07), (165.0, 55)),
    frame("fr_450q", 4, (0.45, 10.5), (0.045, 0.08), (282.0, 30)),
    frame("fr_500q", 4, (0.5, 13.0), (0.05, 0.07), (610.0, 195)),
    frame("fr_550h", 6, (0.55, 10.5), (0.055, 0.08), (478.0, 45)),
    frame("fr_650q_tube", 4, (0.65, 16.0), (0.04, 0.05), (285.0, 120)),
    frame("fr_650q_fold", 4, (0.65, 16.0), (0.06, 0.07), (750.0, 190)),
    frame("fr_680h", 6, (0.695, 13.0), (0.065, 0.07), (600.0, 150)),
    frame("fr_750q_tube", 4, (0.75, 18.0), (0.045, 0.05), (320.0, 150)),
    frame("fr_900h", 6, (0.9, 15.0), (0.085, 0.07), (1100.0, 420)),
    frame("fr_960h", 6, (0.96, 18.0), (0.1, 0.07), (2000.0, 530)),
    frame("fr_1045o", 8, (1.045, 15.0), (0.11, 0.07), (1900.0, 600)),
    frame("fr_1133h", 6, (1.133, 21.0), (0.13, 0.07), (2800.0, 880)),
];

/// rpm/V, ohms, idle amperes; most amperes, watts; cells; grams and credits.
pub(super) static MOTORS: [Part; 20] = [
    motor(
        "m2203_2000",
        (2000.0, 0.245, 0.5),
        (9.0, 90.0),
        (2, 3),
        (17.5, 20),
    ),
    motor(
        "m2306_2450",
        (2450.0, 0.065, 1.2),
        (40.0, 700.0),
        (4, 4),
        (32.0, 25),
    ),
    motor(
        "m2212_920",
        (920.0, 0.21, 0.45),
        (12.0, 160.0),
        (3, 4),
        (57.0, 20),
    ),
    motor(
        "m2212_1150",
        (1150.0, 0.135, 0.7),
        (16.0, 180.0),
        (3, 3),
        (57.0, 20),
    ),
    motor(
        "m2215_900",
        (900.0, 0.142, 0.52),
        (16.0, 235.0),
        (3, 4),
        (69.0, 25),
    ),
    motor(
        "m2217_840",
        (840.0, 0.185, 0.55),
        (18.0, 265.0),
        (3, 4),
        (70.0, 30),
    ),
    motor(
        "m2814_840",
        (840.0, 0.145, 0.7),
        (25.0, 370.0),
        (3, 4),
        (106.0, 40),
    ),
    motor(
        "m2806_400",
        (400.0, 0.645, 0.2),
        (9.4, 216.0),
        (4, 6),
        (46.0, 60),
    ),
    motor(
        "m2806_650",
        (650.0, 0.275, 0.2),
        (12.3, 187.0),
        (4, 4),
        (46.0, 60),
    ),
    motor(
        "m4004_300",
        (300.0, 0.452, 0.2),
        (9.0, 216.0),
        (4, 6),
        (53.0, 70),
    ),
    motor(
        "m4004_400",
        (400.0, 0.359, 0.2),
        (12.0, 300.0),
        (4, 6),
        (53.0, 70),
    ),
    motor(
        "m4006_380",
        (380.0, 0.194, 0.3),
        (16.0, 380.0),
        (4, 6),
        (68.0, 75),
    ),
    motor(
        "m3508_380",
        (380.0, 0.205, 0.4),
        (14.0, 310.0),
        (3, 6),
        (103.0, 70),
    ),
    motor(
        "m3508_580",
        (580.0, 0.09, 0.6),
        (20.0, 440.0),
        (3, 4),
        (103.0, 70),
    ),
    motor(
        "m5006_300",
        (300.0, 0.125, 0.6),
        (20.0, 500.0),
        (4, 6),
        (108.0, 85),
    ),
    motor(
        "m5006_450",
        (450.0, 0.06, 0.9),
        (26.0, 650.0),
        (6, 6),
        (106.0, 85),
    ),
    motor(
        "m5008_340",
        (340.0, 0.064, 0.9),
        (33.0, 750.0),
        (6, 6),
        (135.0, 90),
    ),
    motor(
        "m4114_400",
        (400.0, 0.116, 0.6),
        (25.0, 500.0),
        (4, 6),
        (158.0, 75),
    ),
    motor(
        "m6010_130",
        (130.0, 0.15, 0.5),
        (25.0, 1000.0),
        (12, 12),
        (230.0, 165),
    ),
    motor(
        "m5320_249",
        (249.0, 0.057, 1.4),
        (65.0, 2400.0),
        (10, 12),
        (495.0, 260),
    ),
];

/// Inches of diameter and pitch; `C_T`, `C_P`; most rpm; grams and credits.
pub(super) static PROPELLERS: [Part; 23] = [
    propeller("p5x4.5", (5.0, 4.5), (0.1801, 0.1044), 38000.0, (4.0, 2)),
    propeller("p6x4", (6.0, 4.0), (0.1109, 0.0472), 31600.0, (5.1, 2)),
    propeller("p7x5", (7.0, 5.0), (0.1311, 0.0598), 27100.0, (8.0, 2)),
    propeller("p8x4.5", (8.0, 4.5), (0.1151, 0.0477), 13100.0, (9.1, 2)),
    propeller("p9x4.5", (9.0, 4.5), (0.1077, 0.0418), 11600.0, (11.1, 3)),
    propeller("p9.4x5", (9.4, 5.0), (0.1129, 0.0441), 11000.0, (13.0, 6)),
    propeller("p10x4.5", (10.0, 4.5), (0.1001, 0.037), 10500.0, (15.0, 3)),
    propeller("p10x4.5p", (10.0, 4.5), (0.105, 0.045), 9000.0, (11.0, 2)),
    propeller("p11x4.5", (11.0, 4.5), (0.0903, 0.0318), 9550.0, (17.0, 3)),
    propeller("p12x4.5", (12.0, 4.5), (0.0843, 0.0285), 8750.0, (22.0, 4)),
    propeller("p13x5.5", (13.0, 5.5), (0.0878, 0.0304), 8075.0, (24.0, 5)),
    propeller("p14x5.5", (14.0, 5.5), (0.083, 0.0276), 7500.0, (30.0, 6)),
    propeller("p15x5.5", (15.0, 5.5), (0.0802, 0.0259), 7000.0, (36.0, 6)),
    propeller("p16x5.5", (16.0, 5.5), (0.0746, 0.0238), 6560.0, (44.0, 8)),
    propeller("p18x5.5", (18.0, 5.5), (0.0678, 0.0205), 5830.0, (61.0, 10)),
    propeller("p12x4cf", (12.0, 4.0), (0.082, 0.0298), 9000.0, (12.0, 20)),
    propeller("p15x5cf", (15.0, 5.0), (0.0789, 0.0262), 7000.0, (21.0, 30)),
    propeller(
        "p16x5.4cf",
        (16.0, 5.4),
        (0.0798, 0.0271),
        6500.0,
        (25.0, 30),
    ),
    propeller(
        "p17x5.8cf",
        (17.0, 5.8),
        (0.0677, 0.0217),
        6200.0,
        (27.0, 35),
    ),
    propeller(
        "p18x6.1cf",
        (18.0, 6.1),
        (0.0725, 0.0233),
        5900.0,
        (31.5, 40),
    ),
    propeller("p15x5.2f", (15.0, 5.2), (0.08, 0.029), 7500.0, (13.0, 15)),
    propeller("p21x7f", (21.0, 7.0), (0.0664, 0.0206), 4500.0, (60.0, 55)),
    propeller(
        "p22x10",
        (22.0, 10.0),
        (0.0724, 0.0229),
        4770.0,
        (120.0, 25),
    ),
];

/// Cells in series, ampere hours; most current by capacity; milliohms of a cell; grams and credits.
pub(super) static BATTERIES: [Part; 21] = [
    lipo("b3s2200", (3, 2.2), 25.0, 10.0, (188.0, 20)),
    lipo("b3s5000", (3, 5.0), 30.0, 4.02, (390.0, 40)),
    lipo("b3s5100hv", (3, 5.1), 8.0, 7.63, (325.0, 45)),
    lipo("b4s1300", (4, 1.3), 150.0, 6.91, (156.0, 30)),
    lipo("b4s5000", (4, 5.0), 45.0, 3.28, (480.0, 55)),
    lipo("b4s10000", (4, 10.0), 25.0, 2.2, (940.0, 150)),
    lipo("b6s5000", (6, 5.0), 45.0, 3.28, (740.0, 95)),
    lipo("b6s8000", (6, 8.0), 25.0, 2.75, (1160.0, 190)),
    lipo("b6s10000", (6, 10.0), 25.0, 2.2, (1517.0, 240)),
    lipo("b6s12000", (6, 12.0), 15.0, 2.37, (1670.0, 280)),
    lipo("b6s16000", (6, 16.0), 15.0, 1.78, (1932.0, 330)),
    lipo("b6s22000", (6, 22.0), 25.0, 1.0, (2650.0, 480)),
    lipo("b12s16000", (12, 16.0), 15.0, 1.78, (3950.0, 630)),
    lipo("b12s22000", (12, 22.0), 20.0, 1.12, (5300.0, 750)),
    ion("l4s2p_p45b", (4, 9.0), 7.7, 7.5, (570.0, 95)),
    ion("l6s1p_p50b", (6, 5.0), 9.0, 15.0, (435.0, 75)),
    ion("l6s2p_p45b", (6, 9.0), 7.7, 7.5, (837.0, 130)),
    ion("l6s2p_p50b", (6, 10.0), 9.0, 7.5, (871.0, 145)),
    ion("l6s3p_p50b", (6, 15.0), 9.0, 5.0, (1298.0, 210)),
    ion("l6s4p_m50lt", (6, 19.7), 1.46, 5.5, (1710.0, 215)),
    ion("s6s12_semi", (6, 12.0), 3.0, 7.0, (800.0, 420)),
];

/// Most amperes, cells; efficiency; grams and credits.
pub(super) static ESCS: [Part; 7] = [
    esc("e20", 20.0, 4, 0.9, (12.0, 15)),
    esc("e30opto", 30.0, 4, 0.9, (27.0, 15)),
    esc("e40", 40.0, 6, 0.9, (26.0, 40)),
    esc("e40foc", 40.0, 6, 0.92, (45.0, 70)),
    esc("e60hv", 60.0, 12, 0.91, (49.0, 85)),
    esc("e80hv", 80.0, 12, 0.92, (90.0, 140)),
    esc("e4in1_35", 35.0, 6, 0.9, (3.5, 10)),
];

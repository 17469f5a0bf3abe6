//! Parts for driving: the chassis and drives of ground robots, the hulls and thrusters of boats, and the flail.
//!
//! Sources: sizes, greatest masses and turning radii are those that makers publish for vehicles of the class, named at
//! each row; masses are those vehicles' without motors and battery, and prices are estimated for the class (above 500
//! credits they grow more slowly than real ones, as for equipment). The resistance to rolling is that of pneumatic
//! tyres on short grass, 0.06 to 0.1 by the size of the wheel (Wong, *Theory of Ground Vehicles*, gives 0.05 for
//! compact soil and 0.1 to 0.15 for soft soil); drag areas of robots are assumed from their cross sections. The drag
//! area of a hull is fitted to the speed that its maker publishes, with the thrusters that the maker fits.

use crate::sim::Chassis::{Ackermann, Skid};
use crate::workshop::part::{Chassis, Hull, Part, Spec, Thruster, WheelDrive};

parts! {
    /// - `ch_rc8s`: truggies of the scale 1:8, 0.5 m long.
    /// - `ch_410k`: open robots of 0.4 m with four gear motors, such as the Aion R1.
    /// - `ch_508k`: Clearpath Jackal, 17 kg and 20 kg of load.
    /// - `ch_930k`: `AgileX` Scout 2.0, 62 kg and 50 kg of load.
    /// - `ch_980s`: `AgileX` Hunter SE, 42 kg and 50 kg of load, turns within 1.9 m.
    pub(super) static CHASSIS: [Chassis; 5]
        [id; steering, motors, length_m, track_m, wheel_radius_m, turning_radius_m, rolling, drag_area_m2, max_mass_kg;
         mass_g, credits];
        ["ch_rc8s"; Ackermann, 1,  0.5,  0.3, 0.075, 0.9, 0.08, 0.06,   7.0;  2100.0,  260];
        ["ch_410k";      Skid, 4, 0.41, 0.36, 0.072, 0.0, 0.09,  0.1,  12.0;  2600.0,  230];
        ["ch_508k";      Skid, 4, 0.51, 0.38, 0.098, 0.0, 0.08, 0.12,   37.0;  8500.0,  900];
        ["ch_930k";      Skid, 4, 0.93, 0.58, 0.165, 0.0, 0.06,  0.3, 112.0; 33000.0, 1400];
        ["ch_980s"; Ackermann, 2, 0.98, 0.55, 0.140, 1.9, 0.06, 0.28,  92.0; 25000.0, 1250];
}

parts! {
    /// - `gm_37`: Pololu 37D 30:1, 12 V: 330 rpm and 0.2 A without load, 5.5 A and 14 kg cm stalled.
    /// - `gm_rc8`: a brushless 1:8 car motor of 2100 rpm/V with controller, reduced 11:1 over two differentials.
    /// - `gm_60`: planetary gear motors of 60 mm, 24 V, 120 W.
    /// - `gm_200`: the 200 W drives of `AgileX`'s Scout 2.0, which reach 1.5 m/s.
    /// - `gm_hub350`: hub motors of scooters, 350 W, for 12 cells.
    pub(super) static WHEEL_DRIVES: [WheelDrive; 5]
        [id; kv_rpm_v, resistance_ohm, idle_current_a, max_current_a, efficiency, fewest_cells, most_cells;
         mass_g, credits];
        ["gm_37";      27.5, 2.18, 0.2,  4.0, 0.75,  3,  3;  230.0,  55];
        ["gm_rc8";    190.0, 0.02, 2.5, 80.0,  0.7,  3,  4;  620.0, 180];
        ["gm_60";      9.5,  0.55, 0.6, 12.0, 0.75,  6,  6; 1350.0, 140];
        ["gm_200";     4.2,  0.35, 0.8, 18.0, 0.75,  6,  6; 3400.0, 190];
        ["gm_hub350"; 11.0,  0.28, 0.6, 15.0, 0.88, 12, 12; 3100.0, 210];
}

parts! {
    /// - `hl_090m`: model boats of 0.9 m.
    /// - `hl_120c`: Blue Robotics `BlueBoat`, 1.2 m, 14.5 kg and 15 kg of load, 3 m/s with two thrusters like `th_51`.
    /// - `hl_200c`: Maritime Robotics Otter, 2 m, 55 kg and 30 kg of load, 3 m/s with two thrusters of 180 N.
    /// - `hl_240r`: rigid inflatables of 2.4 m, 40 kg, 3 m/s with one motor like `th_1000` and 70 kg on board.
    pub(super) static HULLS: [Hull; 4]
        [id; motors, length_m, turning_radius_m, drag_area_m2, built_for_kg, max_mass_kg; mass_g, credits];
        ["hl_090m"; 1, 0.9, 2.0, 0.009,   4.0,   8.0;  2200.0,  180];
        ["hl_120c"; 2, 1.2, 0.9, 0.0125, 16.0,  30.0; 10500.0,  800];
        ["hl_200c"; 2, 2.0, 1.4, 0.046,  60.0,  95.0; 38000.0, 1500];
        ["hl_240r"; 1, 2.4, 4.0, 0.038,  70.0, 180.0; 40000.0,  900];
}

parts! {
    /// - `th_51`: Blue Robotics T200, 51 N and 390 W at 16 V.
    /// - `th_158`: Blue Robotics T500, 158 N and 1056 W at 24 V.
    /// - `th_245`: trolling motors of 55 lb, 600 W at 12 V.
    /// - `th_1000`: electric outboards of 1 kW for 48 V, such as the `ePropulsion` Spirit 1.0, without its battery.
    pub(super) static THRUSTERS: [Thruster; 4]
        [id; diameter_m, efficiency, max_power_w, rated_v, fewest_cells, most_cells; mass_g, credits];
        ["th_51";   0.076, 0.315,  390.0, 16.0,  3,  4;   480.0, 270];
        ["th_158";  0.115, 0.41,  1056.0, 24.0,  4,  6;  1250.0, 610];
        ["th_245";   0.28, 0.56,   600.0, 12.0,  3,  4;  5200.0, 240];
        ["th_1000";  0.28, 0.56,  1000.0, 44.0, 12, 12; 10500.0, 800];
}

parts! {
    /// A flail for a robot of this size: assumed from the width that it clears in missions (3 m, with chains of 0.4 m on an
    /// electric shaft). Flails of demining machines weigh tonnes, and work deeper.
    pub(super) static FLAILS: [Spec; 1]
        [id; spec; power_w, mass_g, credits];
        ["s_flail"; Spec::Flail; 250.0, 16000.0, 850];
}

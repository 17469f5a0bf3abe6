//! Equipment: electronics, radios, sensors, loads.
//!
//! Masses, powers and prices are those of typical parts of late 2025. Above 500 credits, prices
//! grow more slowly than real ones, with an exponent of 0.55, so a trainee can earn the most
//! expensive sensor.

use crate::workshop::part::Spec::{Autopilot, Load, Navigation, Payload};
use crate::workshop::part::{Part, PowerModule, Radio, Spec};

parts! {
    /// Flight controllers and satellite navigation.
    pub(super) static AVIONICS: [Spec; 7]
        [id; spec; power_w, mass_g, credits];
        ["fc_h7";     Autopilot; 0.6,   8.0,   75];
        ["fc_px6c";   Autopilot; 2.0,  35.0,  215];
        ["fc_cube";   Autopilot; 3.0,  73.0,  380];
        ["gps_m8n";  Navigation; 0.4,  32.0,   45];
        ["gps_m10";  Navigation; 0.3,  25.0,   60];
        ["gps_f9p";  Navigation; 1.0,  58.0,  320];
        ["gps_crpa"; Navigation; 3.5, 180.0, 1185];
}

parts! {
    pub(super) static POWER_MODULES: [PowerModule; 2]
        [id; max_cells, max_current_a; power_w, mass_g, credits];
        ["pm_02";  6,  60.0; 0.3, 20.0, 30];
        ["pm_hv"; 14, 200.0; 0.6, 65.0, 95];
}

parts! {
    pub(super) static RADIOS: [Radio; 8]
        [id; power_dbm, frequency_mhz, sensitivity_dbm, air_dbi, ground_dbi, losses_db, relays; power_w,
         mass_g, credits];
        ["r_wifi24";  20.0, 2437.0,  -88.0, 2.0, 5.0,  6.0, false; 1.2, 10.0,   20];
        ["r_sik433";  20.0,  433.0, -112.0, 2.0, 2.0, 12.0, false; 0.6, 15.0,   55];
        ["r_sik915";  20.0,  915.0, -112.0, 2.0, 2.0, 12.0, false; 0.6, 15.0,   55];
        ["r_rfd900";  30.0,  915.0, -112.0, 3.0, 2.0,  8.0, false; 4.0, 15.0,  130];
        ["r_elrs24";  20.0, 2440.0, -108.0, 2.0, 5.0,  8.0, false; 0.5,  5.0,   35];
        ["r_lora868"; 22.0,  868.0, -126.0, 2.0, 2.0, 10.0, false; 0.4,  8.0,   25];
        ["r_mesh24";  30.0, 2450.0,  -96.0, 3.0, 5.0,  6.0,  true; 6.0, 60.0, 1010];
        ["r_lte";     23.0,  800.0, -110.0, 2.0, 2.0,  0.0, false; 3.0, 40.0,  150];
}

parts! {
    /// Sensors, droppers and loads. The sprayer's tank lasts for 15 seconds: its mass includes a kilogram of liquid and
    /// a pump with a hose.
    pub(super) static PAYLOADS: [Spec; 21]
        [id; spec; power_w, mass_g, credits];
        ["s_rgb";    Payload;  3.0,   60.0,  120];
        ["s_rgbg";   Payload;  5.0,   95.0,  300];
        ["s_zoom";   Payload; 12.0,  380.0,  640];
        ["s_th160";  Payload;  0.5,   12.0,  230];
        ["s_th320";  Payload;  1.5,   60.0,  915];
        ["s_thdual"; Payload;  9.0,  180.0, 1390];
        ["s_pm25";   Payload;  0.3,   26.0,   45];
        ["s_gas4";   Payload;  0.6,  120.0,  480];
        ["s_tdlas";  Payload;  6.0,  350.0, 2870];
        ["s_voc";    Payload;  0.4,   60.0,  580];
        ["s_mag";    Payload;  1.0,  150.0,  915];
        ["s_md";     Payload;  8.0,  900.0, 1210];
        ["s_gpr";    Payload;  8.0, 1500.0, 3245];
        ["s_geiger"; Payload;  0.3,   50.0,   80];
        ["s_csi";    Payload;  1.0,  300.0, 1675];
        ["s_drop";   Payload;  0.5,   60.0,   45];
        ["s_ball";      Load;  0.0,  500.0,   60];
        ["s_med";       Load;  0.0,  450.0,   25];
        ["s_node";      Load;  0.0,   90.0,   60];
        ["s_spray";  Payload;  2.0, 1450.0,  120];
        ["s_relay";  Payload;  4.0,  150.0,  400];
}

//! Tests of the legibility of themes: contrast, and states that are distinct for every kind of colour vision.

use ratatui::style::{Color, Style};

use super::{MEANINGS, Role, Theme};
use crate::geo::maths;

type Rgb = [f64; 3];

/// Colour vision with all cones, and without one kind of cone, as matrices over linear RGB. G. M.
/// Machado, M. M. Oliveira, L. A. F. Fernandes, "A Physiologically-based Model for Simulation of
/// Color Vision Deficiency", IEEE Transactions on Visualization and Computer Graphics 15 (6), 2009,
/// the matrices of severity 1.0.
const VISIONS: [(&str, [Rgb; 3]); 4] = [
    (
        "all cones",
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    ),
    (
        "protanopia",
        [
            [0.152_286, 1.052_583, -0.204_868],
            [0.114_503, 0.786_281, 0.099_216],
            [-0.003_882, -0.048_116, 1.051_998],
        ],
    ),
    (
        "deuteranopia",
        [
            [0.367_322, 0.860_646, -0.227_968],
            [0.280_085, 0.672_501, 0.047_413],
            [-0.011_820, 0.042_940, 0.968_881],
        ],
    ),
    (
        "tritanopia",
        [
            [1.255_528, -0.076_749, -0.178_779],
            [-0.078_411, 0.930_809, 0.147_602],
            [0.004_733, 0.691_367, 0.303_900],
        ],
    ),
];

/// The minimum distance in CIE 1976 L*a*b* between two states. 2.3 is just noticeable side by side; words on a
/// screen are small, thin and apart.
const LEAST_DISTANCE: f64 = 20.0;
/// The minimum contrast of text: WCAG 2.2, success criterion 1.4.3.
const LEAST_CONTRAST: f64 = 4.5;

/// Red, green and blue of a colour, linear, 0 to 1 (IEC 61966-2-1).
fn linear(colour: Color) -> Rgb {
    let Color::Rgb(r, g, b) = colour else {
        panic!("the themes name their colours as #rrggbb, not {colour}");
    };
    [r, g, b].map(|channel| {
        let value = f64::from(channel) / 255.0;
        if value <= 0.04045 {
            value / 12.92
        } else {
            maths::powf((value + 0.055) / 1.055, 2.4)
        }
    })
}

fn times(matrix: &[Rgb; 3], [r, g, b]: Rgb) -> Rgb {
    matrix.map(|row| row[0] * r + row[1] * g + row[2] * b)
}

/// CIE 1976 L*a*b* of linear RGB under D65 (CIE 15:2004).
fn lab(rgb: Rgb) -> Rgb {
    const XYZ: [Rgb; 3] = [
        [0.412_456_4, 0.357_576_1, 0.180_437_5],
        [0.212_672_9, 0.715_152_2, 0.072_175_0],
        [0.019_333_9, 0.119_192_0, 0.950_304_1],
    ];
    const WHITE: Rgb = [0.950_47, 1.0, 1.088_83];
    let xyz = times(&XYZ, rgb);
    let f = |t: f64| {
        if t > 216.0 / 24_389.0 {
            maths::cbrt(t)
        } else {
            (24_389.0 / 27.0 * t + 16.0) / 116.0
        }
    };
    let [x, y, z] = [0, 1, 2].map(|at| f(xyz[at] / WHITE[at]));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// The difference between two colours for a kind of colour vision, in CIE 1976 L*a*b*.
fn distance(eyes: &[Rgb; 3], a: Color, b: Color) -> f64 {
    let seen = |colour| lab(times(eyes, linear(colour)).map(|value| value.clamp(0.0, 1.0)));
    let (a, b) = (seen(a), seen(b));
    (0..3)
        .map(|at| maths::powi(a[at] - b[at], 2))
        .sum::<f64>()
        .sqrt()
}

/// The contrast ratio of WCAG 2.2: 1 to 21.
fn contrast(a: Color, b: Color) -> f64 {
    let luminance = |colour| {
        let [r, g, b] = linear(colour);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    let (a, b): (f64, f64) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// The embedded themes that have colours.
fn themes() -> impl Iterator<Item = Theme> {
    Theme::names()
        .filter(|name| *name != "monochrome")
        .map(|name| Theme::named(name).expect("embedded"))
}

/// The colours of a role; missing ones come from ordinary text.
fn colours(theme: &Theme, role: Role) -> (Color, Color) {
    let Style { fg, bg, .. } = theme.style(Role::Text).patch(theme.style(role));
    (fg.expect("text has one"), bg.expect("text has one"))
}

#[test]
fn the_formulas_give_the_published_values() {
    let (black, white) = (Color::Rgb(0, 0, 0), Color::Rgb(255, 255, 255));
    assert!((contrast(black, white) - 21.0).abs() < 1e-9);
    // WCAG's own example of the lightest grey that passes on white.
    assert!((contrast(Color::Rgb(0x76, 0x76, 0x76), white) - 4.54).abs() < 0.01);
    assert!((distance(&VISIONS[0].1, black, white) - 100.0).abs() < 0.01);
    // Red and green of equal lightness: distinct for most people, but not for the colour-blind.
    let (red, green) = (Color::Rgb(0xc0, 0x40, 0x20), Color::Rgb(0x60, 0x78, 0x00));
    assert!(distance(&VISIONS[0].1, red, green) > 60.0);
    assert!(distance(&VISIONS[2].1, red, green) < 15.0);
}

#[test]
fn states_stay_apart_for_every_kind_of_colour_vision() {
    const STATES: [Role; 4] = [Role::Ok, Role::Info, Role::Warning, Role::Danger];
    let faults = faults_among(&STATES, LEAST_DISTANCE);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The pairs of these roles that are closer than `least` for some kind of colour vision.
fn faults_among(roles: &[Role], least: f64) -> Vec<String> {
    let mut faults = Vec::new();
    for theme in themes() {
        for (at, &a) in roles.iter().enumerate() {
            for &b in &roles[at + 1..] {
                let (one, other) = (colours(&theme, a), colours(&theme, b));
                for (name, eyes) in &VISIONS {
                    let apart = distance(eyes, one.0, other.0).max(distance(eyes, one.1, other.1));
                    if apart < least {
                        let theme = theme.name();
                        faults.push(format!(
                            "{theme}, {name}: {a:?} and {b:?} are {apart:.1} apart"
                        ));
                    }
                }
            }
        }
    }
    faults
}

#[test]
fn what_lies_on_a_map_and_the_drones_stay_apart_for_every_kind_of_colour_vision() {
    let faults = [
        faults_among(&MEANINGS, 12.0),
        faults_among(&Role::DRONES, 19.0),
    ]
    .concat();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn drones_stay_well_apart_from_one_another_and_from_armed_with_all_cones() {
    let apart = |a, b| distance(&VISIONS[0].1, a, b);
    for theme in themes() {
        let name = theme.name();
        let armed = colours(&theme, Role::Armed).1;
        for (at, &drone) in Role::DRONES.iter().enumerate() {
            let own = colours(&theme, drone).0;
            let to_armed = apart(own, armed);
            assert!(to_armed >= 30.0, "{name}: {drone:?} {to_armed:.1}");
            for &other in &Role::DRONES[at + 1..] {
                let between = apart(own, colours(&theme, other).0);
                assert!(between >= 40.0, "{name}: {drone:?} {other:?} {between:.1}");
            }
        }
    }
}

/// The minimum distance between a drone's colour and a colour with a meaning, with all cones: the
/// vehicle's number is next to it.
const LEAST_OF_DRONES: f64 = 17.0;

#[test]
fn no_drone_has_the_colour_of_something_else_on_the_map() {
    let mut faults = Vec::new();
    for theme in themes() {
        let fg = |role| colours(&theme, role).0;
        for meaning in [
            Role::Fence,
            Role::Contact,
            Role::Hazard,
            Role::Warning,
            Role::Ready,
        ] {
            for drone in Role::DRONES {
                let apart = distance(&VISIONS[0].1, fg(drone), fg(meaning));
                if apart < LEAST_OF_DRONES {
                    let theme = theme.name();
                    faults.push(format!(
                        "{theme}: {drone:?} and {meaning:?} are {apart:.1} apart"
                    ));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn text_has_enough_contrast_wherever_it_stands() {
    let mut faults = Vec::new();
    for theme in themes() {
        // Lines between panes are not text.
        let texts = Role::ALL.iter().filter(|(_, role)| *role != Role::Border);
        for &(name, role) in texts {
            let (fg, bg) = colours(&theme, role);
            let mut grounds = vec![bg];
            // The cursor's line and the header only add a background to other roles, unless they set a text colour
            // too.
            for ground in [Role::Cursor, Role::Header] {
                let style = theme.style(ground);
                let shows_through = style.fg.is_none() || style.fg == theme.style(Role::Text).fg;
                if shows_through && theme.style(role).bg.is_none() {
                    grounds.extend(style.bg);
                }
            }
            for ground in grounds {
                let ratio = contrast(fg, ground);
                if ratio < LEAST_CONTRAST {
                    faults.push(format!(
                        "{}: {name} on {ground} has {ratio:.2}",
                        theme.name()
                    ));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

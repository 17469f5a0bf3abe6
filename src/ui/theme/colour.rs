//! Converts colours for terminals that support fewer colours.

use ratatui::style::Color;

/// The number of colours of a terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourDepth {
    /// No colours: only bold, underline and reverse.
    None,
    /// The sixteen basic colours.
    Sixteen,
    Indexed,
    True,
}

/// The basic colours as xterm shows them by default.
const BASIC: [(Color, [u8; 3]); 16] = [
    (Color::Black, [0, 0, 0]),
    (Color::Red, [205, 0, 0]),
    (Color::Green, [0, 205, 0]),
    (Color::Yellow, [205, 205, 0]),
    (Color::Blue, [0, 0, 238]),
    (Color::Magenta, [205, 0, 205]),
    (Color::Cyan, [0, 205, 205]),
    (Color::Gray, [229, 229, 229]),
    (Color::DarkGray, [127, 127, 127]),
    (Color::LightRed, [255, 0, 0]),
    (Color::LightGreen, [0, 255, 0]),
    (Color::LightYellow, [255, 255, 0]),
    (Color::LightBlue, [92, 92, 255]),
    (Color::LightMagenta, [255, 0, 255]),
    (Color::LightCyan, [0, 255, 255]),
    (Color::White, [255, 255, 255]),
];
/// Colours whose channels differ by less than this are greys.
const LEAST_CHROMA: i32 = 48;
/// The steps of one channel in xterm's colour cube.
const CUBE_STEPS: [u8; 6] = [0, 95, 135, 175, 215, 255];

impl ColourDepth {
    /// The nearest colour of the terminal.
    pub fn map(self, colour: Color) -> Color {
        match (self, colour) {
            (Self::None, _) => Color::Reset,
            (Self::Indexed, Color::Rgb(r, g, b)) => Color::Indexed(nearest_indexed([r, g, b])),
            (Self::Sixteen, Color::Rgb(r, g, b)) => nearest_basic([r, g, b]),
            (Self::Sixteen, Color::Indexed(index)) => nearest_basic(rgb_of_index(index)),
            (_, colour) => colour,
        }
    }
}

fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    a.iter()
        .zip(b)
        .map(|(&x, y)| u32::from(x.abs_diff(y)).pow(2))
        .sum()
}

/// Maps a grey to the nearest grey, and any other colour to the basic colour of its hue; by
/// distance alone, a soft red would become dark grey.
fn nearest_basic(rgb: [u8; 3]) -> Color {
    let nearest = match hue_deg(rgb) {
        None => {
            let greys = BASIC.iter().filter(|(_, basic)| hue_deg(*basic).is_none());
            greys.min_by_key(|(_, basic)| distance(rgb, *basic))
        }
        Some(hue) => {
            let hued = BASIC
                .iter()
                .filter_map(|basic| Some((hue_deg(basic.1)?, basic)));
            let nearest = hued.min_by_key(|(other, (_, basic))| {
                let turn = hue.abs_diff(*other);
                (turn.min(360 - turn), distance(rgb, *basic))
            });
            nearest.map(|(_, basic)| basic)
        }
    };
    nearest.map_or(Color::Reset, |&(colour, _)| colour)
}

/// The angle of a colour on the HSV circle, 0 to 359 degrees; `None` for greys.
fn hue_deg(rgb: [u8; 3]) -> Option<u32> {
    let [r, g, b] = rgb.map(i32::from);
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    let chroma = most - least;
    if chroma < LEAST_CHROMA {
        return None;
    }
    let degrees = if most == r {
        60 * (g - b) / chroma
    } else if most == g {
        120 + 60 * (b - r) / chroma
    } else {
        240 + 60 * (r - g) / chroma
    };
    u32::try_from(degrees.rem_euclid(360)).ok()
}

fn nearest_indexed(rgb: [u8; 3]) -> u8 {
    (16..=255)
        .min_by_key(|&index| distance(rgb, rgb_of_index(index)))
        .unwrap_or(0)
}

fn rgb_of_index(index: u8) -> [u8; 3] {
    match index {
        0..=15 => BASIC[usize::from(index)].1,
        16..=231 => {
            let cell = usize::from(index - 16);
            [cell / 36, cell / 6 % 6, cell % 6].map(|step| CUBE_STEPS[step])
        }
        232..=255 => [8 + 10 * (index - 232); 3],
    }
}

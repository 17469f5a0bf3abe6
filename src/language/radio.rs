//! The settings of a radio under test: `edge`, `loss=5 delay=80 jitter=20 rate=1200`.

use std::ops::RangeInclusive;
use std::time::Duration;

use crate::diagnostic::Diagnostic;
use crate::text;
use crate::vehicle::{RadioPreset, RadioTest};

/// The word that ends a test.
pub(super) const OFF: &str = "off";
/// The words that may stand for settings.
pub(super) const PRESETS: &[&str] = &["off", "good", "edge", "poor", "satellite", "narrow"];

struct RadioSetting {
    name: &'static str,
    /// Spellings of its unit.
    unit: &'static str,
    range: RangeInclusive<f64>,
    set: fn(&mut RadioTest, f64),
}

const SETTINGS: [RadioSetting; 5] = [
    RadioSetting {
        name: "loss",
        unit: "%",
        range: 0.0..=100.0,
        set: |test, percent| test.loss = percent / 100.0,
    },
    RadioSetting {
        name: "delay",
        unit: "ms",
        range: 0.0..=10_000.0,
        set: |test, ms| test.delay = Duration::from_secs_f64(ms / 1e3),
    },
    RadioSetting {
        name: "jitter",
        unit: "ms",
        range: 0.0..=10_000.0,
        set: |test, ms| test.jitter = Duration::from_secs_f64(ms / 1e3),
    },
    RadioSetting {
        name: "rate",
        unit: "B/s",
        range: 100.0..=10_000_000.0,
        set: |test, rate| test.rate = Some(rate),
    },
    RadioSetting {
        name: "seed",
        unit: "",
        range: 0.0..=1_000_000.0,
        set: |test, seed| test.seed = seed as u64,
    },
];

/// The impairment that a preset and the settings after it define; `None` to end the test.
///
/// # Errors
/// The first fault, with its place in the text of the settings.
pub(super) fn radio_test(preset: &str, text: &str) -> Result<Option<RadioTest>, Diagnostic> {
    let mut test = match preset.parse::<RadioPreset>() {
        Ok(preset) => preset.test(),
        Err(_) => RadioTest::default(),
    };
    let mut start = 0;
    for piece in text.split_inclusive(char::is_whitespace) {
        let word = piece.trim_end();
        let span = start..start + word.len();
        start += piece.len();
        if word.is_empty() {
            continue;
        }
        let fault = |message| Diagnostic::new(span.clone(), message);
        let Some((name, value)) = word.split_once('=') else {
            let names = PRESETS.iter().copied();
            return Err(fault(text!("radio-no-setting", word = word)).with_nearest(word, names));
        };
        let Some(setting) = SETTINGS.iter().find(|setting| setting.name == name) else {
            let names = SETTINGS.iter().map(|setting| setting.name);
            return Err(fault(text!("radio-no-setting", word = name)).with_nearest(name, names));
        };
        let number = value.strip_suffix(setting.unit).unwrap_or(value).parse();
        let range = &setting.range;
        let Some(number) = number.ok().filter(|number| range.contains(number)) else {
            return Err(fault(text!(
                "radio-wrong-value",
                word = word,
                least = range.start().to_string(),
                most = range.end().to_string(),
                unit = setting.unit
            )));
        };
        (setting.set)(&mut test, number);
    }
    Ok((preset != OFF).then_some(test))
}

#[cfg(test)]
mod tests {
    use strum::VariantNames as _;

    use super::*;

    #[test]
    fn every_preset_has_its_word() {
        assert_eq!(PRESETS[0], OFF);
        assert_eq!(PRESETS[1..], *RadioPreset::VARIANTS);
    }

    #[test]
    fn settings_change_a_preset() {
        let ms = Duration::from_millis;
        let poor = RadioPreset::Poor.test();
        for (preset, text, expected) in [
            ("off", "", None),
            ("poor", "", Some(poor)),
            (
                "poor",
                "rate=1200 loss=5%",
                Some(RadioTest {
                    loss: 0.05,
                    rate: Some(1200.0),
                    ..poor
                }),
            ),
            (
                "",
                "delay=80ms  jitter=20 seed=7",
                Some(RadioTest {
                    delay: ms(80),
                    jitter: ms(20),
                    seed: 7,
                    ..RadioTest::default()
                }),
            ),
        ] {
            assert_eq!(radio_test(preset, text), Ok(expected), "{preset} {text}");
        }
    }

    #[test]
    fn faults_point_at_the_word() {
        for (text, place, message) in [
            ("egde", "egde", "unknown setting `egde`"),
            ("loss=5 dely=80", "dely=80", "unknown setting `dely`"),
            ("loss=5 loss=101", "loss=101", "0 to 100 %"),
            ("rate=x", "rate=x", "100 to 10000000 B/s"),
            ("delay=NaN", "delay=NaN", "0 to 10000 ms"),
        ] {
            let fault = radio_test("", text).expect_err(text);
            assert_eq!(&text[fault.span], place);
            assert!(
                fault.message.to_string().contains(message),
                "{}",
                fault.message
            );
        }
    }
}

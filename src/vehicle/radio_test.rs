//! An impaired radio, simulated on request to test a link, and its measured traffic.

use std::time::Duration;

use strum::{EnumString, VariantNames};

use crate::text;
use crate::text::Text;

/// An impairment of the radio in both directions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RadioTest {
    /// The share of frames lost, 0 to 1.
    pub loss: f64,
    /// The delay in each direction.
    pub delay: Duration,
    /// The maximum random delay added to `delay`.
    pub jitter: Duration,
    /// The bytes per second in each direction; `None` for no limit.
    pub rate: Option<f64>,
    /// The seed of losses and jitter.
    pub seed: u64,
}

/// A typical radio, as a preset for a test.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, VariantNames)]
#[strum(serialize_all = "kebab-case", ascii_case_insensitive)]
pub enum RadioPreset {
    /// A radio in range.
    Good,
    /// A radio at the edge of its range.
    Edge,
    /// A radio that can hardly be used.
    Poor,
    /// The link of a geostationary satellite: long delays.
    Satellite,
    /// A radio of 9600 baud.
    Narrow,
}

impl RadioPreset {
    /// The test with the impairment of this radio.
    pub fn test(self) -> RadioTest {
        let ms = Duration::from_millis;
        let of = |loss: f64, delay_ms, jitter_ms, rate| RadioTest {
            loss,
            delay: ms(delay_ms),
            jitter: ms(jitter_ms),
            rate,
            seed: 0,
        };
        match self {
            Self::Good => of(0.001, 15, 5, None),
            Self::Edge => of(0.05, 80, 0, None),
            Self::Poor => of(0.2, 200, 100, None),
            Self::Satellite => of(0.0, 600, 0, None),
            Self::Narrow => of(0.0, 0, 0, Some(1200.0)),
        }
    }
}

impl RadioTest {
    /// The test's figures in one line.
    pub fn text(&self) -> Text {
        let figures = text!(
            "radio-figures",
            loss = percent(self.loss),
            delay = self.delay.as_millis().to_string(),
            jitter = self.jitter.as_millis().to_string()
        );
        let rate = self
            .rate
            .map(|rate| text!("radio-rate", rate = format!("{rate:.0}")));
        Text::joined(", ", std::iter::once(figures).chain(rate).collect())
    }
}

fn percent(share: f64) -> String {
    let text = format!("{:.1}", 100.0 * share);
    text.trim_end_matches(".0").to_owned()
}

/// The frames passed and lost in one direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RadioTraffic {
    pub passed: u64,
    pub lost: u64,
    /// The size of the frames that passed, in bytes.
    pub bytes: u64,
}

impl RadioTraffic {
    /// The share of frames lost, 0 to 1.
    pub fn loss(&self) -> f64 {
        self.lost as f64 / (self.passed + self.lost).max(1) as f64
    }
}

/// A radio under test, and what was measured since the test began.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TestedRadio {
    pub test: RadioTest,
    /// How long the test lasts.
    pub lasts: Duration,
    pub received: RadioTraffic,
    pub sent: RadioTraffic,
}

impl TestedRadio {
    /// The requested impairment and the measured traffic, as text.
    pub fn text(&self, round_trip: Option<Duration>) -> Text {
        text!(
            "radio-line",
            asked = self.test.text(),
            measured = self.measured(round_trip)
        )
    }

    fn measured(&self, round_trip: Option<Duration>) -> Text {
        let seconds = self.lasts.as_secs_f64().max(1.0);
        let rate = |traffic: RadioTraffic| format!("{:.0}", traffic.bytes as f64 / seconds);
        let trip = round_trip.map_or_else(|| "-".to_owned(), |trip| trip.as_millis().to_string());
        text!(
            "radio-measured",
            lost_in = percent(self.received.loss()),
            lost_out = percent(self.sent.loss()),
            trip = trip,
            bytes_in = rate(self.received),
            bytes_out = rate(self.sent)
        )
    }
}

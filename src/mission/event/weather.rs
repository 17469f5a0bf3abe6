//! Events that change the weather, at once or gradually, permanently or for a while.

use std::time::Duration;

use crate::mission::weather::Weather;

/// A quantity of the weather that can change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Element {
    WindSpeed,
    WindDirection,
    Gust,
    Temperature,
}

impl Element {
    /// All elements by their names in files, with their valid ranges.
    pub const ALL: [(&str, Self, std::ops::RangeInclusive<f64>); 4] = [
        ("weather.wind.speed", Self::WindSpeed, 0.0..=60.0),
        ("weather.wind.dir", Self::WindDirection, 0.0..=360.0),
        ("weather.gust", Self::Gust, 0.0..=20.0),
        ("weather.temp_c", Self::Temperature, -40.0..=60.0),
    ];

    pub fn names() -> Vec<&'static str> {
        Self::ALL.iter().map(|(name, ..)| *name).collect()
    }

    /// The element with this name, with its valid range; `None` if there is none.
    pub fn named(name: &str) -> Option<(Self, std::ops::RangeInclusive<f64>)> {
        let mut all = Self::ALL.into_iter();
        let (_, element, range) = all.find(|(known, ..)| *known == name)?;
        Some((element, range))
    }

    fn get(self, weather: &Weather) -> f64 {
        match self {
            Self::WindSpeed => weather.wind.speed_m_s,
            Self::WindDirection => weather.wind.from_deg,
            Self::Gust => weather.gust_m_s,
            Self::Temperature => weather.temperature_c,
        }
    }

    fn set(self, weather: &mut Weather, value: f64) {
        match self {
            Self::WindSpeed => weather.wind.speed_m_s = value.max(0.0),
            Self::WindDirection => weather.wind.from_deg = value.rem_euclid(360.0),
            Self::Gust => weather.gust_m_s = value.max(0.0),
            Self::Temperature => weather.temperature_c = value,
        }
    }

    /// Interpolates from one value towards another; directions take the shorter way.
    fn between(self, from: f64, to: f64, share: f64) -> f64 {
        let difference = match self {
            Self::WindDirection => (to - from + 180.0).rem_euclid(360.0) - 180.0,
            Self::WindSpeed | Self::Gust | Self::Temperature => to - from,
        };
        from + difference * share
    }
}

/// A change of the weather.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Change {
    pub element: Element,
    pub to: Target,
    /// The time over which the change takes effect.
    pub ramp: Duration,
    /// How long it lasts before it reverts; `None` for the rest of the flight.
    pub lasts: Option<Duration>,
}

impl Change {
    /// The wind speed after the change, in m/s; `None` if it changes something else.
    pub fn wind_m_s(&self, before_m_s: f64) -> Option<f64> {
        let to_m_s = match self.to {
            Target::Value(value) => value,
            Target::More(more) => before_m_s + more,
        };
        (self.element == Element::WindSpeed).then_some(to_m_s)
    }
}

/// The value that a change leads to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Target {
    Value(f64),
    /// An increase over the current value.
    More(f64),
}

/// A change that is under way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Drift {
    change: Change,
    from: f64,
    to: f64,
    /// The value to revert to, if it reverts.
    back_to: f64,
    since: Duration,
}

impl Drift {
    /// A change that begins now. It replaces the one under way: it starts from the current value, and reverts to the
    /// value that the other would have ended with.
    pub fn new(change: Change, weather: &Weather, now: Duration, replaced: Option<&Self>) -> Self {
        let from = change.element.get(weather);
        Self {
            change,
            from,
            back_to: replaced.map_or(from, Self::in_the_end),
            to: match change.to {
                Target::Value(value) => value,
                Target::More(more) => from + more,
            },
            since: now,
        }
    }

    /// The value after the change is over.
    fn in_the_end(&self) -> f64 {
        if self.change.lasts.is_some() {
            self.back_to
        } else {
            self.to
        }
    }

    /// The element of the weather that changes.
    pub fn element(&self) -> Element {
        self.change.element
    }

    /// Advances the weather; returns the change that follows, if any.
    pub fn step(self, weather: &mut Weather, now: Duration) -> Option<Self> {
        let passed = now.saturating_sub(self.since);
        let share = if passed >= self.change.ramp {
            1.0
        } else {
            passed.as_secs_f64() / self.change.ramp.as_secs_f64()
        };
        let element = self.change.element;
        element.set(weather, element.between(self.from, self.to, share));
        match self.change.lasts {
            Some(lasts) if passed >= lasts && share >= 1.0 => Some(Self {
                change: Change {
                    lasts: None,
                    ..self.change
                },
                from: self.to,
                to: self.back_to,
                since: now,
                ..self
            }),
            None if share >= 1.0 => None,
            _ => Some(self),
        }
    }
}

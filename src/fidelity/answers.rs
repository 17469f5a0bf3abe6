//! The answers of two vehicles, in order.

use std::collections::BTreeMap;

use serde::Serialize;

/// One answer of a vehicle, with its time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Said {
    pub at_s: f64,
    pub text: String,
}

impl Said {
    pub fn new(at_s: f64, text: String) -> Self {
        Self { at_s, text }
    }

    /// A status text. Its numbers are ignored: no two flights touch the ground at exactly the same speed.
    pub fn text(at_s: f64, severity: u8, text: &str) -> Self {
        let mut words = format!("[{severity}] ");
        for letter in text.chars() {
            if !letter.is_ascii_digit() {
                words.push(letter);
            } else if !words.ends_with('#') {
                words.push('#');
            }
        }
        Self::new(at_s, words)
    }
}

/// The first difference between two sequences of answers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FirstDifference {
    /// Its index in the sequence, from 0.
    pub place: usize,
    /// The time of the recorded answer, or of the simulated one after the last recorded answer, in
    /// seconds since the recording began.
    pub at_s: f64,
    /// The answer of the real vehicle; `None` after its last one.
    pub recorded: Option<String>,
    /// The answer of the simulated vehicle at this index; `None` after its last one.
    pub simulated: Option<String>,
}

/// The comparison of the answers of one kind.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Answers {
    /// The kind: acks, texts, modes or reached.
    pub kind: &'static str,
    /// The number of answers of the real vehicle.
    pub recorded: usize,
    /// The number of answers of the simulated vehicle.
    pub simulated: usize,
    /// The first difference; `None` if the sequences are identical.
    pub first_difference: Option<FirstDifference>,
    /// Answers that only the real vehicle gave, with their number.
    pub missing: BTreeMap<String, usize>,
    /// Answers that only the simulated vehicle gave, with their number.
    pub extra: BTreeMap<String, usize>,
}

impl Answers {
    /// Compares the answers after the time `from_s`, in seconds.
    pub(super) fn new(kind: &'static str, from_s: f64, real: &[Said], simulated: &[Said]) -> Self {
        let since = |all: &[Said]| -> Vec<Said> {
            let later = all.iter().filter(|said| said.at_s >= from_s);
            later.cloned().collect()
        };
        let (real, simulated) = (since(real), since(simulated));
        Self {
            kind,
            recorded: real.len(),
            simulated: simulated.len(),
            first_difference: first_difference(&real, &simulated),
            missing: only_in(&real, &simulated),
            extra: only_in(&simulated, &real),
        }
    }

    /// Whether both vehicles sent the same answers in the same order.
    pub fn identical(&self) -> bool {
        self.first_difference.is_none()
    }
}

fn first_difference(real: &[Said], simulated: &[Said]) -> Option<FirstDifference> {
    let text = |said: Option<&Said>| said.map(|said| said.text.clone());
    let place = (0..real.len().max(simulated.len()))
        .find(|place| text(real.get(*place)) != text(simulated.get(*place)))?;
    let said = real.get(place).or(simulated.get(place))?;
    Some(FirstDifference {
        place,
        at_s: said.at_s,
        recorded: text(real.get(place)),
        simulated: text(simulated.get(place)),
    })
}

fn only_in(these: &[Said], those: &[Said]) -> BTreeMap<String, usize> {
    let mut left: BTreeMap<String, usize> = BTreeMap::new();
    for said in these {
        *left.entry(said.text.clone()).or_default() += 1;
    }
    for said in those {
        if let Some(count) = left.get_mut(&said.text) {
            *count = count.saturating_sub(1);
        }
    }
    left.retain(|_, count| *count > 0);
    left
}

//! The user's description of a forward: its address and its filters.

use std::fmt;
use std::str::FromStr;

use mavlink::Message as _;
use mavlink::dialects::ardupilotmega::MavMessage;

use crate::text;
use crate::text::Text;

/// The id of HEARTBEAT. A station that does not receive it shows no vehicle, so filters always let it pass.
const HEARTBEAT: u32 = 0;
const HIGHEST_RATE_HZ: f64 = 1000.0;

/// A forward: `ADDR [read-only] [only NAME,NAME] [except NAME,NAME] [rate HZ]`.
///
/// The filters apply to messages without a receiver. Answers to the station always pass, and so does HEARTBEAT.
#[derive(Debug, Clone, PartialEq)]
pub struct ForwardSpec {
    /// The address as it was written.
    pub address: String,
    /// Whether the station's messages are not passed on to the vehicles.
    pub read_only: bool,
    /// The message ids that pass; empty for all.
    pub only: Vec<u32>,
    /// The message ids that do not pass.
    pub except: Vec<u32>,
    /// The maximum number of messages per second of each kind and sender; `None` for no limit.
    pub rate_hz: Option<f64>,
}

/// Why a text does not describe a forward.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0)]
pub struct ForwardFault(Text);

impl From<&ForwardFault> for Text {
    fn from(fault: &ForwardFault) -> Self {
        fault.0.clone()
    }
}

impl ForwardSpec {
    /// A forward that carries everything in both directions.
    pub fn open(address: impl Into<String>) -> Self {
        Self {
            address: address.into(),
            read_only: false,
            only: Vec::new(),
            except: Vec::new(),
            rate_hz: None,
        }
    }

    /// Whether messages with this id pass the filters.
    pub fn passes(&self, id: u32) -> bool {
        let is_named = self.only.is_empty() || self.only.contains(&id);
        id == HEARTBEAT || (is_named && !self.except.contains(&id))
    }

    /// Whether the rate of a kind of message is limited. Answers and events are sent only once, so none may be left
    /// out.
    pub fn is_paced(&self, id: u32) -> bool {
        /// `PARAM_VALUE`, `MISSION_CURRENT`, `MISSION_ITEM_REACHED`, `LOG_ENTRY`, `LOG_DATA`, `AUTOPILOT_VERSION`,
        /// `HOME_POSITION`, STATUSTEXT.
        const ONCE: [u32; 8] = [22, 42, 46, 118, 120, 148, 242, 253];
        self.rate_hz.is_some() && id != HEARTBEAT && !ONCE.contains(&id)
    }
}

impl fmt::Display for ForwardSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.address)?;
        if self.read_only {
            f.write_str(" read-only")?;
        }
        for (word, ids) in [("only", &self.only), ("except", &self.except)] {
            if !ids.is_empty() {
                let names: Vec<String> = ids.iter().map(|&id| name(id)).collect();
                write!(f, " {word} {}", names.join(","))?;
            }
        }
        match self.rate_hz {
            Some(rate) => write!(f, " rate {rate}"),
            None => Ok(()),
        }
    }
}

impl FromStr for ForwardSpec {
    type Err = ForwardFault;

    fn from_str(text: &str) -> Result<Self, ForwardFault> {
        let mut words = text.split_whitespace();
        let address = words.next().ok_or(ForwardFault(text!("forward-empty")))?;
        let mut spec = Self::open(address);
        while let Some(word) = words.next() {
            let mut value = || {
                words
                    .next()
                    .ok_or(ForwardFault(text!("forward-no-value", word = word)))
            };
            match word {
                "read-only" => spec.read_only = true,
                "only" => spec.only = ids(value()?)?,
                "except" => spec.except = ids(value()?)?,
                "rate" => spec.rate_hz = Some(rate(value()?)?),
                _ => return Err(ForwardFault(text!("forward-unknown-word", word = word))),
            }
        }
        Ok(spec)
    }
}

fn rate(word: &str) -> Result<f64, ForwardFault> {
    let rate: Option<f64> = word.parse().ok();
    rate.filter(|rate| (0.1..=HIGHEST_RATE_HZ).contains(rate))
        .ok_or(ForwardFault(text!("forward-wrong-rate", word = word)))
}

fn ids(words: &str) -> Result<Vec<u32>, ForwardFault> {
    let id = |word: &str| {
        let named = MavMessage::message_id_from_name(&word.to_ascii_uppercase());
        named
            .or_else(|| word.parse().ok())
            .ok_or(ForwardFault(text!("forward-no-message", word = word)))
    };
    words
        .split(',')
        .filter(|word| !word.is_empty())
        .map(id)
        .collect()
}

/// The name of a message, or its number if the dialect lacks it.
fn name(id: u32) -> String {
    MavMessage::default_message_from_id(id)
        .map_or_else(|| id.to_string(), |it| it.message_name().to_owned())
}

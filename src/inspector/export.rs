//! The statistics of all messages as a table for other programs.

use std::time::Duration;

use serde::Serialize;

use super::census::{Census, Direction, MessageTally, TallyKey};
use super::reading::name_of;
use crate::wire::SenderLoss;

/// The format of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StatisticsFormat {
    Csv,
    Json,
}

impl StatisticsFormat {
    /// The format for the extension of a file's name; `None` for any other extension.
    pub fn of(path: &str) -> Option<Self> {
        let (_, ending) = path.rsplit_once('.')?;
        match ending.to_ascii_lowercase().as_str() {
            "csv" => Some(Self::Csv),
            "json" => Some(Self::Json),
            _ => None,
        }
    }
}

/// A link with its counts, and the time of the counts on its clock.
#[derive(Debug, Clone, Copy)]
pub struct CountedLink<'a> {
    pub name: &'a str,
    pub census: &'a Census,
    pub now: Duration,
}

/// One message of one sender. The names of the fields are the columns, with their units.
#[derive(Debug, Serialize)]
struct StatisticsRow<'a> {
    link: &'a str,
    direction: &'static str,
    peer: String,
    system: u8,
    component: u8,
    message_id: u32,
    message: String,
    messages: u64,
    bytes: u64,
    window_s: f64,
    rate_hz: f64,
    bytes_per_s: f64,
    interval_mean_ms: Option<f64>,
    jitter_ms: Option<f64>,
    interval_max_ms: Option<f64>,
    silence_max_ms: f64,
    /// Frames of the sender, of any kind, that are missing in its sequence numbers.
    sender_lost: Option<u64>,
    sender_loss_percent: Option<f64>,
}

/// A table of all messages: CSV with a header, or a JSON array of objects with the same names.
pub fn statistics_table(links: &[CountedLink<'_>], format: StatisticsFormat) -> String {
    let rows: Vec<StatisticsRow> = links.iter().flat_map(rows).collect();
    match format {
        StatisticsFormat::Csv => csv_of(&rows),
        StatisticsFormat::Json => serde_json::to_string_pretty(&rows).unwrap_or_default() + "\n",
    }
}

fn csv_of(rows: &[StatisticsRow<'_>]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        // Writing to memory cannot fail.
        let _ = writer.serialize(row);
    }
    let bytes = writer.into_inner().unwrap_or_default();
    String::from_utf8_lossy(&bytes).into_owned()
}

fn rows<'a>(link: &CountedLink<'a>) -> Vec<StatisticsRow<'a>> {
    let credible = link.census.tallies();
    let credible = credible.filter(|(key, tally)| link.census.is_credible(*key, tally));
    credible.map(|(key, tally)| row(link, key, tally)).collect()
}

fn row<'a>(link: &CountedLink<'a>, key: TallyKey, tally: &MessageTally) -> StatisticsRow<'a> {
    let source = key.source;
    let statistics = &tally.statistics;
    let rate = statistics.rate(link.now);
    let peer = link.census.peer_name(source.peer).map(str::to_owned);
    let loss = link.census.loss_of(source);
    StatisticsRow {
        link: link.name,
        direction: match source.direction {
            Direction::In => "in",
            Direction::Out => "out",
        },
        peer: peer.unwrap_or_else(|| source.peer.to_string()),
        system: source.system,
        component: source.component,
        message_id: key.message,
        message: name_of(key.message),
        messages: statistics.count,
        bytes: statistics.bytes,
        window_s: rounded(statistics.window(link.now).as_secs_f64()),
        rate_hz: rounded(rate.hz),
        bytes_per_s: rounded(rate.bytes_s),
        interval_mean_ms: statistics.mean_interval().map(milliseconds),
        jitter_ms: statistics.jitter().map(milliseconds),
        interval_max_ms: statistics.longest_interval().map(milliseconds),
        silence_max_ms: milliseconds(statistics.longest_silence(link.now)),
        sender_lost: loss.map(SenderLoss::lost),
        sender_loss_percent: loss.map(|loss| rounded(100.0 * loss.share())),
    }
}

fn milliseconds(time: Duration) -> f64 {
    rounded(time.as_secs_f64() * 1e3)
}

/// A value rounded to three decimals.
fn rounded(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inspector::FrameWay;
    use crate::wire::{Encoder, ground_station_heartbeat};

    fn counted() -> Census {
        let mut census = Census::default();
        let mut encoder = Encoder::new(7, 1);
        for second in 0..5 {
            let mut beat = Vec::new();
            encoder.encode(&ground_station_heartbeat(), &mut beat);
            // One of the frames is lost.
            if second != 2 {
                let at = Duration::from_secs(second);
                census.note(FrameWay::received(0), &beat, true, at);
            }
        }
        census.name_peer(0, "10.0.0.9:14550".to_owned());
        census
    }

    fn table(format: StatisticsFormat) -> String {
        let census = counted();
        let link = CountedLink {
            name: "udpin:0.0.0.0:14550, \"field\"",
            census: &census,
            now: Duration::from_secs(8),
        };
        statistics_table(&[link], format)
    }

    #[test]
    fn a_table_has_units_in_its_header_and_a_row_per_message_and_sender() {
        assert_eq!(
            table(StatisticsFormat::Csv),
            "link,direction,peer,system,component,message_id,message,messages,bytes,window_s,rate_hz,bytes_per_s,\
             interval_mean_ms,jitter_ms,interval_max_ms,silence_max_ms,sender_lost,sender_loss_percent\n\
             \"udpin:0.0.0.0:14550, \"\"field\"\"\",in,10.0.0.9:14550,7,1,0,HEARTBEAT,4,84,8.0,0.5,10.5,\
             1333.333,577.35,2000.0,4000.0,1,20.0\n"
        );
    }

    #[test]
    fn the_same_table_as_json() {
        let read: serde_json::Value =
            serde_json::from_str(&table(StatisticsFormat::Json)).expect("JSON");
        assert_eq!(read[0]["message"], "HEARTBEAT");
        assert_eq!(read[0]["jitter_ms"], 577.35);
    }

    #[test]
    fn the_ending_of_a_file_decides_the_format() {
        for (path, format) in [
            ("a.csv", Some(StatisticsFormat::Csv)),
            ("~/b/A.JSON", Some(StatisticsFormat::Json)),
            ("csv", None),
            ("a.txt", None),
        ] {
            assert_eq!(StatisticsFormat::of(path), format, "{path}");
        }
    }
}

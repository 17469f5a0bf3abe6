//! MCAP, the container of Foxglove and ROS: a channel per vehicle and kind of message, with JSON in it.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;

use ::mcap::records::MessageHeader;
use ::mcap::write::NoSeek;
use ::mcap::{McapError, WriteOptions, Writer};
use mavlink::dialects::ardupilotmega::MavMessage;
use serde_json::{Map, Value, json};

use super::{create, records};
use crate::inspector::{ElementReading, FieldReading, name_of, read};
use crate::replay::Film;
use crate::wire::{Anatomy, Content, Decoder, SystemId};

const LOCATION_SCHEMA: &str = r#"{"title":"foxglove.LocationFix","type":"object","properties":{
"timestamp":{"type":"object","title":"time","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},
"frame_id":{"type":"string"},"latitude":{"type":"number"},"longitude":{"type":"number"},"altitude":{"type":"number"},
"position_covariance":{"type":"array","items":{"type":"number"}},"position_covariance_type":{"type":"integer"}}}"#;

/// Converts an error; if the disk is full or gone, the system's own error is returned.
fn failed(error: McapError) -> io::Error {
    if let McapError::Io(error) = error {
        error
    } else {
        io::Error::other(error.to_string())
    }
}

/// Writes all messages that can be verified to a new file.
pub(super) fn write(film: &Film, to: &Path) -> io::Result<()> {
    let file = create(to.to_owned())?;
    fill(film, options().create(file).map_err(failed)?)
}

/// Writes all messages that can be verified to a stream.
pub(super) fn stream(film: &Film, mut to: impl io::Write) -> io::Result<()> {
    let options = options().disable_seeking(true);
    fill(film, options.create(NoSeek::new(&mut to)).map_err(failed)?)?;
    to.flush()
}

fn options() -> WriteOptions {
    WriteOptions::new().compression(None).profile("")
}

fn fill(film: &Film, writer: Writer<impl io::Write + io::Seek>) -> io::Result<()> {
    let records = records(film).map_err(|fault| io::Error::other(fault.to_string()))?;
    let mut file = McapFile {
        writer,
        channels: BTreeMap::new(),
        places: BTreeMap::new(),
        count: 0,
    };
    for record in records {
        file.add(record.unix_us, &record.bytes).map_err(failed)?;
    }
    file.writer.finish().map_err(failed)?;
    Ok(())
}

struct McapFile<W: io::Write + io::Seek> {
    writer: Writer<W>,
    /// The channel of each sender and kind of message.
    channels: BTreeMap<(SystemId, u8, u32), u16>,
    /// The channel of each vehicle's positions.
    places: BTreeMap<SystemId, u16>,
    count: u32,
}

impl<W: io::Write + io::Seek> McapFile<W> {
    fn add(&mut self, unix_us: u64, bytes: &[u8]) -> Result<(), McapError> {
        let Some(frame) = Anatomy::of(bytes) else {
            return Ok(());
        };
        let reading = read(&frame);
        if !reading.is_verified {
            return Ok(());
        }
        let key = (frame.system, frame.component, frame.id);
        let channel = if let Some(&channel) = self.channels.get(&key) {
            channel
        } else {
            let name = name_of(frame.id);
            let topic = format!("/mavlink/{}/{}/{name}", frame.system, frame.component);
            let schema = schema(&reading.values).to_string();
            let name = format!("mavlink.{name}");
            let channel = self.channel(&topic, &name, &schema)?;
            self.channels.insert(key, channel);
            channel
        };
        let values = reading.values.iter();
        let fields = values.map(|field| (field.name.to_owned(), value(field)));
        let object = Value::Object(fields.collect::<Map<String, Value>>());
        self.put(channel, unix_us, &object)?;
        self.add_place(unix_us, bytes)
    }

    /// Adds the position in a message as well, in Foxglove's own schema.
    fn add_place(&mut self, unix_us: u64, bytes: &[u8]) -> Result<(), McapError> {
        let mut decoder = Decoder::new();
        decoder.push(bytes);
        let Some(frame) = decoder.next_frame() else {
            return Ok(());
        };
        let Content::Message(MavMessage::GLOBAL_POSITION_INT(position)) = &frame.content else {
            return Ok(());
        };
        let channel = if let Some(&channel) = self.places.get(&frame.system) {
            channel
        } else {
            let topic = format!("/vehicle/{}/location", frame.system);
            let channel = self.channel(&topic, "foxglove.LocationFix", LOCATION_SCHEMA)?;
            self.places.insert(frame.system, channel);
            channel
        };
        let fix = json!({
            "timestamp": {"sec": unix_us / 1_000_000, "nsec": unix_us % 1_000_000 * 1000},
            "frame_id": format!("vehicle_{}", frame.system),
            "latitude": f64::from(position.lat) / 1e7,
            "longitude": f64::from(position.lon) / 1e7,
            "altitude": f64::from(position.alt) / 1e3,
            "position_covariance": [0, 0, 0, 0, 0, 0, 0, 0, 0],
            "position_covariance_type": 0,
        });
        self.put(channel, unix_us, &fix)
    }

    fn channel(&mut self, topic: &str, name: &str, schema: &str) -> Result<u16, McapError> {
        let schema = self
            .writer
            .add_schema(name, "jsonschema", schema.as_bytes())?;
        self.writer
            .add_channel(schema, topic, "json", &BTreeMap::new())
    }

    fn put(&mut self, channel: u16, unix_us: u64, object: &Value) -> Result<(), McapError> {
        self.count += 1;
        let header = MessageHeader {
            channel_id: channel,
            sequence: self.count,
            log_time: unix_us * 1000,
            publish_time: unix_us * 1000,
        };
        let data = object.to_string();
        self.writer.write_to_known_channel(&header, data.as_bytes())
    }
}

fn schema(fields: &[FieldReading]) -> Value {
    let properties = fields.iter().map(|field| {
        let kind = match field.elements.len() {
            _ if field.text.is_some() => json!({"type": "string"}),
            1 => json!({"type": "number", "description": field.unit}),
            _ => json!({"type": "array", "items": {"type": "number"}}),
        };
        (field.name.to_owned(), kind)
    });
    json!({"type": "object", "properties": properties.collect::<Map<String, Value>>()})
}

fn value(field: &FieldReading) -> Value {
    if let Some(text) = &field.text {
        return json!(text);
    }
    // JSON has no NaN: such a number becomes null.
    let number = |element: &ElementReading| match *element {
        ElementReading::Unsigned(value) => json!(value),
        ElementReading::Signed(value) => json!(value),
        ElementReading::Single(value) => json!(value),
        ElementReading::Double(value) => json!(value),
    };
    match &field.elements[..] {
        [one] => number(one),
        many => many.iter().map(number).collect(),
    }
}

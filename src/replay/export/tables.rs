//! A table for each kind of message.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

use super::{create, records};
use crate::inspector::{FieldReading, name_of, read};
use crate::replay::Film;
use crate::wire::Anatomy;

type Table = csv::Writer<BufWriter<File>>;

/// Writes a folder of tables, `HEARTBEAT.csv` and so on: a row per message, a column per field, one per element of an
/// array.
pub(super) fn write(film: &Film, folder: &Path) -> io::Result<()> {
    std::fs::create_dir(folder)?;
    let mut tables: BTreeMap<u32, Table> = BTreeMap::new();
    let records = records(film).map_err(|fault| io::Error::other(fault.to_string()))?;
    for record in records {
        let Some(frame) = Anatomy::of(&record.bytes) else {
            continue;
        };
        let reading = read(&frame);
        // The fields of an unverified message are unknown.
        if !reading.is_verified {
            continue;
        }
        let table = match tables.entry(frame.id) {
            std::collections::btree_map::Entry::Occupied(table) => table.into_mut(),
            std::collections::btree_map::Entry::Vacant(place) => {
                let path = folder.join(format!("{}.csv", name_of(frame.id)));
                let mut table = csv::Writer::from_writer(create(path)?);
                table.write_record(header(&reading.values))?;
                place.insert(table)
            }
        };
        let (system, component) = (frame.system.to_string(), frame.component.to_string());
        let seconds = format!("{:.6}", record.unix_us as f64 / 1e6);
        let own = [seconds, system, component, frame.sequence.to_string()];
        let cells = reading.values.iter().flat_map(cells);
        table.write_record(own.into_iter().chain(cells))?;
    }
    for mut table in tables.into_values() {
        table.flush()?;
    }
    Ok(())
}

fn header(values: &[FieldReading]) -> Vec<String> {
    let own = ["unix_s", "system", "component", "sequence"].map(str::to_owned);
    let fields = values.iter().flat_map(|field| {
        let count = if field.text.is_some() {
            1
        } else {
            field.elements.len()
        };
        (0..count).map(move |at| match (count, field.unit) {
            (1, "") => field.name.to_owned(),
            (1, unit) => format!("{} [{unit}]", field.name),
            (_, "") => format!("{}.{at}", field.name),
            (_, unit) => format!("{}.{at} [{unit}]", field.name),
        })
    });
    own.into_iter().chain(fields).collect()
}

fn cells(field: &FieldReading) -> Vec<String> {
    match &field.text {
        Some(text) => vec![text.clone()],
        None => field.elements.iter().map(ToString::to_string).collect(),
    }
}

//! Repair of unreadable rows from a copy of the database.
//!
//! `SQLite` detects damaged pages, but not a damaged byte within a text.

use std::path::Path;

use rusqlite::{Connection, TransactionBehavior, params};

use super::rescue::copies;
use super::schema::{DOCUMENTS, DocumentColumn, Notation};
use crate::text;
use crate::text::Text;

/// The outcome of a search for damaged rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MendedRows {
    /// No row is damaged.
    Sound,
    /// Some rows were damaged.
    Damaged {
        /// The number of rows restored from a copy.
        restored: usize,
        /// The number of rows that stay damaged, because no copy has them.
        lost: usize,
    },
}

impl MendedRows {
    /// The outcome for the user; `None` if no row is damaged.
    pub fn text(self) -> Option<Text> {
        let Self::Damaged { restored, lost } = self else {
            return None;
        };
        let restored = (restored > 0).then(|| text!("profiles-mended", count = restored));
        let lost = (lost > 0).then(|| text!("profiles-unmended", count = lost));
        Some(Text::joined(
            "; ",
            restored.into_iter().chain(lost).collect(),
        ))
    }
}

/// A row with an unreadable document.
struct RottenRow {
    profile: i64,
    key: String,
}

/// Restores unreadable rows from the newest copy in which they are readable; others stay as they
/// are.
pub(super) fn mend_rows(connection: &mut Connection, path: &Path) -> rusqlite::Result<MendedRows> {
    let (mut restored, mut lost) = (0, 0);
    for column in DOCUMENTS {
        let rotten = rotten_rows(connection, &column)?;
        for row in rotten {
            let found = copies(path)
                .iter()
                .find_map(|copy| kept(copy, &column, &row));
            let Some(document) = found else {
                lost += 1;
                continue;
            };
            let transaction =
                connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
            let DocumentColumn {
                table, column, key, ..
            } = column;
            let update =
                format!("UPDATE {table} SET {column} = ?1 WHERE profile = ?2 AND {key} = ?3");
            restored += transaction.execute(&update, params![document, row.profile, row.key])?;
            transaction.commit()?;
        }
    }
    Ok(if restored + lost > 0 {
        MendedRows::Damaged { restored, lost }
    } else {
        MendedRows::Sound
    })
}

fn rotten_rows(
    connection: &Connection,
    column: &DocumentColumn,
) -> rusqlite::Result<Vec<RottenRow>> {
    let DocumentColumn {
        table,
        column: document,
        key,
        notation,
    } = column;
    let mut query =
        connection.prepare(&format!("SELECT profile, {key}, {document} FROM {table}"))?;
    let mut rows = query.query([])?;
    let mut rotten = Vec::new();
    while let Some(row) = rows.next()? {
        let bytes = row.get_ref(2)?.as_bytes().unwrap_or_default();
        if readable(bytes, *notation).is_none() {
            // A row whose key is damaged too cannot be found in a copy.
            if let (Ok(profile), Ok(key)) = (row.get(0), row.get(1)) {
                rotten.push(RottenRow { profile, key });
            }
        }
    }
    Ok(rotten)
}

/// The document of a row in a copy of the database; `None` if the copy or the document cannot be read.
fn kept(copy: &Path, column: &DocumentColumn, row: &RottenRow) -> Option<String> {
    let flags = rusqlite::OpenFlags::SQLITE_OPEN_READ_ONLY;
    let connection = Connection::open_with_flags(copy, flags).ok()?;
    let DocumentColumn {
        table,
        column: document,
        key,
        notation,
    } = column;
    let select = format!("SELECT {document} FROM {table} WHERE profile = ?1 AND {key} = ?2");
    let text: String = connection
        .query_row(&select, params![row.profile, row.key], |row| row.get(0))
        .ok()?;
    readable(text.as_bytes(), *notation).map(str::to_owned)
}

/// The text of a document; `None` if it is not UTF-8 or does not have this notation.
fn readable(document: &[u8], notation: Notation) -> Option<&str> {
    let text = std::str::from_utf8(document).ok()?;
    let is_sound = match notation {
        Notation::Json => serde_json::from_str::<serde::de::IgnoredAny>(text).is_ok(),
        Notation::Toml => toml::from_str::<toml::Table>(text).is_ok(),
    };
    is_sound.then_some(text)
}

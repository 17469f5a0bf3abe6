//! The tables, and their migration from earlier versions.

use rusqlite::{Connection, TransactionBehavior};

/// The changes from each version of the tables to the next.
const STEPS: [&str; 1] = ["
    CREATE TABLE profiles (
        -- Never used again: whoever still holds a removed profile must not write into somebody else's.
        key INTEGER PRIMARY KEY AUTOINCREMENT,
        name TEXT NOT NULL UNIQUE COLLATE NOCASE,
        since TEXT NOT NULL,
        settings TEXT NOT NULL
    ) STRICT;
    CREATE TABLE entries (
        number INTEGER PRIMARY KEY,
        profile INTEGER NOT NULL REFERENCES profiles (key) ON DELETE CASCADE,
        id TEXT NOT NULL,
        at TEXT NOT NULL,
        entry TEXT NOT NULL,
        UNIQUE (profile, id)
    ) STRICT;
    CREATE TABLE runs (
        profile INTEGER NOT NULL,
        id TEXT NOT NULL,
        ended TEXT NOT NULL,
        revision INTEGER NOT NULL,
        seed INTEGER NOT NULL,
        backend TEXT NOT NULL,
        airframes TEXT NOT NULL,
        report TEXT NOT NULL,
        recording TEXT,
        PRIMARY KEY (profile, id),
        FOREIGN KEY (profile, id) REFERENCES entries (profile, id) ON DELETE CASCADE
    ) STRICT, WITHOUT ROWID;
    CREATE TABLE designs (
        profile INTEGER NOT NULL REFERENCES profiles (key) ON DELETE CASCADE,
        name TEXT NOT NULL COLLATE NOCASE,
        design TEXT NOT NULL,
        PRIMARY KEY (profile, name)
    ) STRICT, WITHOUT ROWID;
"];

/// The notation of a document in a column.
#[derive(Clone, Copy)]
pub(super) enum Notation {
    Json,
    Toml,
}

/// A column with a document in each row.
#[derive(Clone, Copy)]
pub(super) struct DocumentColumn {
    pub table: &'static str,
    pub column: &'static str,
    /// The column that identifies a row within one profile.
    pub key: &'static str,
    pub notation: Notation,
}

/// All columns that hold JSON documents.
pub(super) const DOCUMENTS: [DocumentColumn; 3] = [
    DocumentColumn {
        table: "entries",
        column: "entry",
        key: "id",
        notation: Notation::Json,
    },
    DocumentColumn {
        table: "runs",
        column: "report",
        key: "id",
        notation: Notation::Json,
    },
    DocumentColumn {
        table: "designs",
        column: "design",
        key: "name",
        notation: Notation::Toml,
    },
];

/// The version of the tables that this program writes.
pub(super) const VERSION: i32 = STEPS.len() as i32;

/// Migrates the tables in one transaction. Returns the resulting version; tables newer than
/// [`VERSION`] are not changed.
pub(super) fn migrate(connection: &mut Connection) -> rusqlite::Result<i32> {
    let found = version(connection)?;
    if found >= VERSION {
        return Ok(found);
    }
    let transaction = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
    // Another console may have migrated them already.
    let found = version(&transaction)?;
    for step in STEPS
        .iter()
        .skip(usize::try_from(found).unwrap_or_default())
    {
        transaction.execute_batch(step)?;
    }
    let now = found.max(VERSION);
    transaction.pragma_update(None, "user_version", now)?;
    transaction.commit()?;
    Ok(now)
}

pub(super) fn version(connection: &Connection) -> rusqlite::Result<i32> {
    connection.query_row("PRAGMA user_version", [], |row| row.get(0))
}

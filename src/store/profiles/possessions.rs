//! A trainee's possessions: licences for parts, and designs.

use rusqlite::params;

use super::{Profile, ProfileError, Profiles, json};
use crate::campaign::{CareerEntry, CareerStanding, MissionCourse, Purchase};
use crate::workshop::Design;

impl Profiles {
    /// Buys the licence for a part. Two consoles cannot spend the same credits twice.
    ///
    /// # Errors
    /// The part cannot be bought, or the database cannot be written; then nothing is paid.
    pub fn buy(
        &mut self,
        profile: &Profile,
        part: &str,
        course: &MissionCourse,
        when: &str,
    ) -> Result<Purchase, ProfileError> {
        let transaction = self.transaction()?;
        let standing = CareerStanding::of(&self.history(profile)?);
        let purchase = standing.buy(part, course).map_err(ProfileError::Refused)?;
        let entry = json(&CareerEntry::Purchase(purchase.clone()));
        let added = transaction.execute(
            "INSERT INTO entries (profile, id, at, entry) VALUES (?1, ?2, ?3, ?4)",
            params![profile.key, format!("part {part}"), when, entry],
        );
        added
            .and_then(|_| transaction.commit())
            .map_err(|error| self.fault(error))?;
        Ok(purchase)
    }

    /// A profile's designs, by name.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn designs(&self, profile: &Profile) -> Result<Vec<Design>, ProfileError> {
        let mut query = self.ask("SELECT design FROM designs WHERE profile = ?1 ORDER BY name")?;
        let rows = query
            .query_map([profile.key], |row| row.get::<_, String>(0))
            .and_then(Iterator::collect::<Result<Vec<_>, _>>)
            .map_err(|error| self.fault(error))?;
        // A design with an unknown part is left out here, but stays in the file.
        Ok(rows
            .iter()
            .filter_map(|toml| Design::from_toml(toml).ok())
            .collect())
    }

    /// Stores a design; it replaces a design of the same name.
    ///
    /// # Errors
    /// The database cannot be written.
    pub fn keep_design(&self, profile: &Profile, design: &Design) -> Result<(), ProfileError> {
        let kept = self.connection.execute(
            "INSERT INTO designs (profile, name, design) VALUES (?1, ?2, ?3)
             ON CONFLICT (profile, name) DO UPDATE SET name = excluded.name, design = excluded.design",
            params![profile.key, design.name, design.to_toml()],
        );
        kept.map(drop).map_err(|error| self.fault(error))
    }

    /// Removes a design.
    ///
    /// # Errors
    /// The database cannot be written.
    pub fn drop_design(&self, profile: &Profile, name: &str) -> Result<(), ProfileError> {
        let removed = self.connection.execute(
            "DELETE FROM designs WHERE profile = ?1 AND name = ?2",
            params![profile.key, name],
        );
        removed.map(drop).map_err(|error| self.fault(error))
    }

    /// Replaces the design named `from` with `design`, which has the new name, in one transaction.
    ///
    /// # Errors
    /// The database cannot be written.
    pub fn rename_design(
        &self,
        profile: &Profile,
        from: &str,
        design: &Design,
    ) -> Result<(), ProfileError> {
        let transaction = self.transaction()?;
        // The old design is removed first, because the names may differ only in case.
        self.drop_design(profile, from)?;
        self.keep_design(profile, design)?;
        transaction.commit().map_err(|error| self.fault(error))
    }
}

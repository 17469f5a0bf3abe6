//! A class on several machines that is to be made.

/// What a class on several machines is to be.
#[derive(Debug, Clone)]
pub struct NewClass<'a> {
    /// Its name: letters, digits, `-` and `_`; also the name of its folder of records.
    pub name: &'a str,
    /// How many seats it has.
    pub seats: u16,
    /// Where the desk will listen, each as HOST:PORT.
    pub addresses: &'a [String],
}

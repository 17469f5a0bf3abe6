//! Deflate (RFC 1951), as far as a KMZ needs it: one block of memory in, one out.

use crate::fault::ArchiveFault;

/// The most bytes that are unpacked: far more than any plan, and no harm to memory.
pub(super) const LARGEST: usize = 16 * 1024 * 1024;

/// Lengths and distances: the first value of each code, and the bits that follow it (RFC 1951, 3.2.5).
const LENGTHS: [(usize, u32); 29] = [
    (3, 0),
    (4, 0),
    (5, 0),
    (6, 0),
    (7, 0),
    (8, 0),
    (9, 0),
    (10, 0),
    (11, 1),
    (13, 1),
    (15, 1),
    (17, 1),
    (19, 2),
    (23, 2),
    (27, 2),
    (31, 2),
    (35, 3),
    (43, 3),
    (51, 3),
    (59, 3),
    (67, 4),
    (83, 4),
    (99, 4),
    (115, 4),
    (131, 5),
    (163, 5),
    (195, 5),
    (227, 5),
    (258, 0),
];
const DISTANCES: [(usize, u32); 30] = [
    (1, 0),
    (2, 0),
    (3, 0),
    (4, 0),
    (5, 1),
    (7, 1),
    (9, 2),
    (13, 2),
    (17, 3),
    (25, 3),
    (33, 4),
    (49, 4),
    (65, 5),
    (97, 5),
    (129, 6),
    (193, 6),
    (257, 7),
    (385, 7),
    (513, 8),
    (769, 8),
    (1025, 9),
    (1537, 9),
    (2049, 10),
    (3073, 10),
    (4097, 11),
    (6145, 11),
    (8193, 12),
    (12_289, 12),
    (16_385, 13),
    (24_577, 13),
];
/// The order of the lengths of the code of code lengths (3.2.7).
const ORDER: [usize; 19] = [
    16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15,
];
const LONGEST_CODE: usize = 15;

pub(super) fn inflate(packed: &[u8]) -> Result<Vec<u8>, ArchiveFault> {
    let mut bits = Bits {
        bytes: packed,
        at: 0,
    };
    let mut out = Vec::new();
    loop {
        let is_last = bits.take(1)? == 1;
        match bits.take(2)? {
            0 => stored(&mut bits, &mut out)?,
            1 => {
                let mut lengths = [8; 288];
                lengths[144..256].fill(9);
                lengths[256..280].fill(7);
                block(
                    &mut bits,
                    &mut out,
                    &Code::new(&lengths),
                    &Code::new(&[5; 30]),
                )?;
            }
            2 => {
                let (literals, distances) = codes(&mut bits)?;
                block(&mut bits, &mut out, &literals, &distances)?;
            }
            _ => return Err(ArchiveFault::Damaged),
        }
        if is_last {
            return Ok(out);
        }
    }
}

struct Bits<'a> {
    bytes: &'a [u8],
    /// In bits.
    at: usize,
}

impl Bits<'_> {
    fn take(&mut self, count: u32) -> Result<usize, ArchiveFault> {
        let mut value = 0;
        for place in 0..count {
            let byte = self.bytes.get(self.at / 8).ok_or(ArchiveFault::Damaged)?;
            value |= usize::from(byte >> (self.at % 8) & 1) << place;
            self.at += 1;
        }
        Ok(value)
    }
}

/// A Huffman code in its canonical form: how many codes there are of each length, and the symbols in order.
struct Code {
    counts: [usize; LONGEST_CODE + 1],
    symbols: Vec<usize>,
}

impl Code {
    fn new(lengths: &[usize]) -> Self {
        let mut counts = [0; LONGEST_CODE + 1];
        let mut symbols = Vec::new();
        for (length, count) in counts.iter_mut().enumerate().skip(1) {
            let of_length = lengths.iter().enumerate().filter(|(_, it)| **it == length);
            let before = symbols.len();
            symbols.extend(of_length.map(|(symbol, _)| symbol));
            *count = symbols.len() - before;
        }
        Self { counts, symbols }
    }

    fn read(&self, bits: &mut Bits<'_>) -> Result<usize, ArchiveFault> {
        let (mut code, mut first, mut index) = (0, 0, 0);
        for count in self.counts.iter().skip(1) {
            code |= bits.take(1)?;
            if code < first + count {
                let place = (index + code).checked_sub(first);
                let symbol = place.and_then(|place| self.symbols.get(place));
                return symbol.copied().ok_or(ArchiveFault::Damaged);
            }
            index += count;
            first = (first + count) << 1;
            code <<= 1;
        }
        Err(ArchiveFault::Damaged)
    }
}

fn stored(bits: &mut Bits<'_>, out: &mut Vec<u8>) -> Result<(), ArchiveFault> {
    bits.at = bits.at.next_multiple_of(8);
    let (length, complement) = (bits.take(16)?, bits.take(16)?);
    if length ^ complement != 0xFFFF {
        return Err(ArchiveFault::Damaged);
    }
    let start = bits.at / 8;
    out.extend(
        bits.bytes
            .get(start..start + length)
            .ok_or(ArchiveFault::Damaged)?,
    );
    bits.at += 8 * length;
    if out.len() > LARGEST {
        Err(ArchiveFault::TooLarge)
    } else {
        Ok(())
    }
}

/// The codes of a block that brings its own.
fn codes(bits: &mut Bits<'_>) -> Result<(Code, Code), ArchiveFault> {
    let (literals, distances) = (bits.take(5)? + 257, bits.take(5)? + 1);
    let mut lengths = [0; 19];
    for place in ORDER.iter().take(bits.take(4)? + 4) {
        lengths[*place] = bits.take(3)?;
    }
    let code = Code::new(&lengths);
    let mut lengths: Vec<usize> = Vec::new();
    while lengths.len() < literals + distances {
        let (value, times) = match code.read(bits)? {
            16 => (
                *lengths.last().ok_or(ArchiveFault::Damaged)?,
                bits.take(2)? + 3,
            ),
            17 => (0, bits.take(3)? + 3),
            18 => (0, bits.take(7)? + 11),
            length => (length, 1),
        };
        lengths.extend(std::iter::repeat_n(value, times));
    }
    if lengths.len() > literals + distances {
        return Err(ArchiveFault::Damaged);
    }
    let (first, second) = lengths.split_at(literals);
    Ok((Code::new(first), Code::new(second)))
}

fn block(
    bits: &mut Bits<'_>,
    out: &mut Vec<u8>,
    literals: &Code,
    distances: &Code,
) -> Result<(), ArchiveFault> {
    const END: usize = 256;
    loop {
        let symbol = literals.read(bits)?;
        if let Ok(byte) = u8::try_from(symbol) {
            out.push(byte);
        } else if symbol == END {
            return Ok(());
        } else {
            let length = extended(bits, &LENGTHS, symbol - END - 1)?;
            let code = distances.read(bits)?;
            let distance = extended(bits, &DISTANCES, code)?;
            let start = out
                .len()
                .checked_sub(distance)
                .ok_or(ArchiveFault::Damaged)?;
            // The copy may overlap with what it appends.
            for at in start..start + length {
                out.push(out[at]);
            }
        }
        if out.len() > LARGEST {
            return Err(ArchiveFault::TooLarge);
        }
    }
}

fn extended(
    bits: &mut Bits<'_>,
    table: &[(usize, u32)],
    code: usize,
) -> Result<usize, ArchiveFault> {
    let (base, further) = table.get(code).ok_or(ArchiveFault::Damaged)?;
    Ok(base + bits.take(*further)?)
}

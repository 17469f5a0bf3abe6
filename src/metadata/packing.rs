//! Files of metadata as a vehicle stores them: JSON, mostly compressed with xz. A vehicle is not trusted: sizes are
//! limited.

use std::io::{Cursor, Read as _};
use std::num::NonZeroUsize;

use xz4rust::{XzDecoder, XzReader};

use crate::text;
use crate::text::Text;

/// The largest file that is read from a vehicle, in bytes: PX4's have less than 200 kB.
pub const LARGEST_PACKED: u32 = 4 * 1024 * 1024;
/// The largest file after decompression, in bytes: PX4's have less than 2 MB.
const LARGEST: usize = 16 * 1024 * 1024;
/// The largest dictionary of a compressed file, in bytes: that of the highest usual compression (`xz -9`).
const LARGEST_DICTIONARY: usize = 64 * 1024 * 1024;
/// The first bytes of a file that is compressed with xz.
const XZ: &[u8] = b"\xfd7zXZ\0";
const BUFFER: NonZeroUsize = NonZeroUsize::new(16 * 1024).expect("it is not zero");

/// The text of a file, decompressed if it is compressed.
///
/// # Errors
/// It is damaged, too large, or not a text.
pub fn unpacked(bytes: Vec<u8>) -> Result<String, Text> {
    let bytes = if is_packed(&bytes) {
        decompressed(bytes)?
    } else {
        bytes
    };
    if bytes.len() > LARGEST {
        return Err(too_large());
    }
    String::from_utf8(bytes).map_err(|_| text!("metadata-not-text"))
}

/// Whether a file is compressed.
pub fn is_packed(bytes: &[u8]) -> bool {
    bytes.starts_with(XZ)
}

fn decompressed(bytes: Vec<u8>) -> Result<Vec<u8>, Text> {
    let decoder = XzDecoder::in_heap_with_alloc_dict_size(BUFFER.get(), LARGEST_DICTIONARY);
    let reader = XzReader::new_with_buffer_size_and_decoder(Cursor::new(bytes), BUFFER, decoder);
    let mut expanded = Vec::new();
    let read = reader.take(LARGEST as u64 + 1).read_to_end(&mut expanded);
    if expanded.len() > LARGEST {
        return Err(too_large());
    }
    match read {
        Ok(_) => Ok(expanded),
        Err(fault) => Err(text!("metadata-damaged", fault = fault.to_string())),
    }
}

fn too_large() -> Text {
    text!("metadata-too-large", most = LARGEST / 1024 / 1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `{"version": 1}` twelve times, compressed by `xz -9`.
    const PACKED: &[u8] = include_bytes!("../../fuzz/seeds/documentation/twelve.json.xz");

    #[test]
    fn a_compressed_file_is_expanded_and_a_plain_one_is_kept() {
        let text = unpacked(PACKED.to_vec()).expect("it is whole");
        assert_eq!(text, "{\"version\": 1}".repeat(12));
        assert_eq!(unpacked(b"{}".to_vec()), Ok("{}".to_owned()));
        assert!(unpacked(vec![0xff, 0xfe]).is_err());
    }

    #[test]
    fn a_damaged_or_cut_off_file_is_an_error() {
        for length in XZ.len()..PACKED.len() {
            assert!(unpacked(PACKED[..length].to_vec()).is_err(), "{length}");
        }
        let mut damaged = PACKED.to_vec();
        damaged[PACKED.len() / 2] ^= 0x40;
        assert!(unpacked(damaged).is_err());
    }

    #[test]
    fn a_small_file_that_expands_without_end_is_refused() {
        // 20 MB of zeros.
        let bomb = include_bytes!("../../fuzz/seeds/documentation/zeros.xz");
        let fault = unpacked(bomb.to_vec()).expect_err("it is too large");
        assert!(fault.to_string().contains("16 MB"), "{fault}");
    }
}

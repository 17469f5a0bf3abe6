//! The checksums of MAVLink: of a frame, and of a file that MAVLink FTP transfers.

use crc::{Algorithm, CRC_16_MCRF4XX, Crc, Digest, Table};

/// The CRC of a frame. With a table for sixteen bytes at a time, a check takes a fifth of the time.
const FRAME: Crc<u16, Table<16>> = Crc::<u16, Table<16>>::new(&CRC_16_MCRF4XX);

/// CRC-32 as MAVLink FTP defines it: it starts at zero and has no inversions, unlike the CRC-32 of
/// zip.
static FILE: Crc<u32> = Crc::<u32>::new(&Algorithm {
    width: 32,
    poly: 0x04C1_1DB7,
    init: 0,
    refin: true,
    refout: true,
    xorout: 0,
    check: 0x2DFD_2D88,
    residue: 0,
});

/// The checksum of a frame from its second byte to the end of its payload; `seed` is the message's
/// CRC seed in the dialect (`CRC_EXTRA`).
pub(super) fn of_frame(covered: &[u8], seed: u8) -> u16 {
    let mut digest = FRAME.digest();
    digest.update(covered);
    digest.update(&[seed]);
    digest.finalize()
}

/// The checksum of a file in MAVLink FTP, from its bytes in order.
#[derive(Clone)]
pub struct FtpChecksum(Digest<'static, u32>);

impl Default for FtpChecksum {
    fn default() -> Self {
        Self(FILE.digest())
    }
}

impl FtpChecksum {
    /// The checksum of a whole file.
    pub fn of(bytes: &[u8]) -> u32 {
        FILE.checksum(bytes)
    }

    /// Adds the next bytes of the file.
    pub fn add(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    /// The checksum of all bytes so far.
    pub fn value(self) -> u32 {
        self.0.finalize()
    }
}

#[cfg(test)]
mod tests {
    use proptest::collection::vec;
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn a_frame_has_the_checksum_of_the_dialect(covered in vec(any::<u8>(), 0..280), seed: u8) {
            prop_assert_eq!(of_frame(&covered, seed), mavlink::calculate_crc(&covered, seed));
        }
    }

    #[test]
    fn a_file_has_the_checksum_of_its_parts() {
        assert_eq!(FtpChecksum::of(b""), 0);
        let mut sum = FtpChecksum::default();
        sum.add(b"1234");
        sum.add(b"56789");
        assert_eq!(sum.value(), 0x2DFD_2D88);
        assert_eq!(FtpChecksum::of(b"123456789"), 0x2DFD_2D88);
    }
}

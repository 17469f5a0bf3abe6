//! The checksum of a file.

/// CRC-32 as `MAVLink` defines it for files: it starts at zero, and has no inversions, unlike that of zip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FtpChecksum(u32);

const TABLE: [u32; 256] = table();

const fn table() -> [u32; 256] {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut crc = byte as u32;
        let mut bit = 0;
        while bit < 8 {
            crc = (crc >> 1) ^ if crc & 1 == 1 { 0xEDB8_8320 } else { 0 };
            bit += 1;
        }
        table[byte] = crc;
        byte += 1;
    }
    table
}

impl FtpChecksum {
    /// Adds the next bytes of the file.
    pub fn add(&mut self, bytes: &[u8]) {
        self.0 = bytes.iter().fold(self.0, |crc, byte| {
            (crc >> 8) ^ TABLE[usize::from(crc as u8 ^ byte)]
        });
    }

    /// The sum of all bytes so far.
    pub fn value(self) -> u32 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_that_of_the_simulated_vehicle() {
        let mut sum = FtpChecksum::default();
        assert_eq!(sum.value(), 0);
        sum.add(b"1234");
        sum.add(b"56789");
        assert_eq!(sum.value(), 0x2DFD_2D88);
    }
}

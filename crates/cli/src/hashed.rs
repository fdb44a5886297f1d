//! A reader that computes the SHA-256 of its input.

use std::io::{self, BufRead, Read};

use hmac_sha256::Hash;

/// A reader with the SHA-256 of the bytes read so far.
pub(crate) struct Hashed<R> {
    input: R,
    digest: Hash,
    bytes: u64,
}

impl<R: BufRead> Hashed<R> {
    pub(crate) fn new(input: R) -> Self {
        Self {
            input,
            digest: Hash::new(),
            bytes: 0,
        }
    }

    /// Returns the number of bytes read, and their hash in hexadecimal digits.
    pub(crate) fn finish(self) -> (u64, String) {
        let digest = self.digest.finalize();
        let digits = digest.map(|byte| format!("{byte:02x}")).concat();
        (self.bytes, digits)
    }
}

impl<R: BufRead> Read for Hashed<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut given = self.fill_buf()?;
        let read = given.read(buffer)?;
        self.consume(read);
        Ok(read)
    }
}

impl<R: BufRead> BufRead for Hashed<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.input.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        // The buffer is full, so this call returns it again without another read.
        if let Ok(given) = self.input.fill_buf() {
            self.digest.update(given.get(..amount).unwrap_or(given));
        }
        self.bytes += amount as u64;
        self.input.consume(amount);
    }
}

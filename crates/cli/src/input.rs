//! A file or stdin, with the SHA-256 of its bytes.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path;

use hmac_sha256::Hash;

/// The bytes of a file or of stdin, with their SHA-256 if it is wanted.
pub(crate) struct Input {
    bytes: Box<dyn Read>,
    digest: Option<Hash>,
    read: u64,
}

impl Input {
    /// Opens a file, or stdin for the name `-`.
    pub(crate) fn open(path: &Path, is_hashed: bool) -> io::Result<BufReader<Self>> {
        let bytes: Box<dyn Read> = if path == Path::new("-") {
            Box::new(io::stdin())
        } else {
            Box::new(File::open(path)?)
        };
        let input = Self {
            bytes,
            digest: is_hashed.then(Hash::new),
            read: 0,
        };
        Ok(BufReader::with_capacity(1 << 16, input))
    }

    /// Reads the rest, and returns the number of all bytes and their hash in hexadecimal digits, if it is wanted.
    pub(crate) fn finish(mut self) -> io::Result<Option<(u64, String)>> {
        if self.digest.is_some() {
            io::copy(&mut self, &mut io::sink())?;
        }
        let digits = |digest: Hash| digest.finalize().map(|byte| format!("{byte:02x}")).concat();
        Ok(self.digest.map(|digest| (self.read, digits(digest))))
    }
}

/// Returns the name of a file in messages.
pub(crate) fn name_of(path: &Path) -> String {
    if path == Path::new("-") {
        "stdin".into()
    } else {
        path.display().to_string()
    }
}

impl Read for Input {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.bytes.read(buffer)?;
        if let (Some(digest), Some(given)) = (&mut self.digest, buffer.get(..count)) {
            digest.update(given);
        }
        self.read += count as u64;
        Ok(count)
    }
}

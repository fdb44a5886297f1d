//! The bytes of a file, decompressed, in UTF-8 if they are text.

use std::io::{self, BufRead, BufReader, Cursor, Read};

use flate2::bufread::GzDecoder;

use crate::encoding::TextEncoding;
use crate::error::{Error, Fault};

/// The number of bytes that are read before the kind and the dialect of a file are decided.
const SAMPLE: usize = 1 << 18;

/// The decompressed bytes of a file.
pub(crate) type Bytes<'r> = io::Chain<Cursor<Vec<u8>>, BufReader<Box<dyn Read + 'r>>>;

/// The decompressed bytes of a file, with a sample of them.
pub(crate) struct Input<'r> {
    pub(crate) sample: Vec<u8>,
    /// True if the sample is the whole file.
    pub(crate) is_whole: bool,
    /// The largest number of bytes that are kept as a whole.
    most: Option<u64>,
    rest: Box<dyn Read + 'r>,
}

impl<'r> Input<'r> {
    /// Decompresses a file if it is compressed by gzip, and converts UTF-16 and the given encoding to UTF-8.
    pub(crate) fn open(
        input: impl Read + 'r,
        encoding: Option<TextEncoding>,
        most: Option<u64>,
    ) -> Result<Self, Error> {
        let raw = Self::sampled(Box::new(input), most)?;
        let source = if raw.sample.starts_with(b"\x1f\x8b") {
            Self::sampled(Box::new(Members(Some(GzDecoder::new(raw.all())))), most)?
        } else {
            raw
        };
        match encoding.or_else(|| utf_16(&source.sample)) {
            None => Ok(source),
            Some(encoding) => {
                let text = encoding.decode(&source.bytes()?);
                Self::sampled(Box::new(Cursor::new(text)), most)
            }
        }
    }

    fn sampled(mut rest: Box<dyn Read + 'r>, most: Option<u64>) -> Result<Self, Error> {
        let mut sample = Vec::new();
        (&mut rest).take(SAMPLE as u64).read_to_end(&mut sample)?;
        Ok(Self {
            is_whole: sample.len() < SAMPLE,
            sample,
            most,
            rest,
        })
    }

    /// Returns all bytes.
    pub(crate) fn all(self) -> Bytes<'r> {
        let rest = BufReader::with_capacity(1 << 16, self.rest);
        Cursor::new(self.sample).chain(rest)
    }

    /// Returns all bytes in memory.
    pub(crate) fn bytes(self) -> Result<Vec<u8>, Error> {
        // Without a limit, no file has so many bytes.
        let most = self.most.unwrap_or(u64::MAX);
        let mut bytes = Vec::new();
        self.all()
            .take(most.saturating_add(1))
            .read_to_end(&mut bytes)?;
        if bytes.len() as u64 > most {
            return Err(Fault::new(format!(
                "more than {most} bytes of a file that is kept as a whole: write a text in UTF-8, which is read line by line"
            ))
            .at(1));
        }
        Ok(bytes)
    }
}

/// Returns the encoding of a text in UTF-16, which begins with a byte order mark or has zeros beside ASCII.
fn utf_16(sample: &[u8]) -> Option<TextEncoding> {
    let is_text = |byte: &u8| byte.is_ascii_graphic() || byte.is_ascii_whitespace();
    match sample {
        [0xff, 0xfe, ..] => Some(TextEncoding::Utf16Le),
        [0xfe, 0xff, ..] => Some(TextEncoding::Utf16Be),
        [a, 0, b, 0, ..] if is_text(a) && is_text(b) => Some(TextEncoding::Utf16Le),
        [0, a, 0, b, ..] if is_text(a) && is_text(b) => Some(TextEncoding::Utf16Be),
        _ => None,
    }
}

/// The members of a gzip file, one after the other. Zeros after the last one pad the file to whole blocks.
struct Members<R>(Option<GzDecoder<R>>);

impl<R: BufRead> Read for Members<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let damaged = |reason: &str| io::Error::new(io::ErrorKind::InvalidData, reason);
        while let Some(member) = &mut self.0 {
            let read = member.read(buffer).map_err(|error| match error.kind() {
                io::ErrorKind::InvalidInput
                | io::ErrorKind::UnexpectedEof
                | io::ErrorKind::Other => damaged("the compressed data are damaged or cut off"),
                _ => error,
            })?;
            if read > 0 || buffer.is_empty() {
                return Ok(read);
            }
            let Some(mut rest) = self.0.take().map(GzDecoder::into_inner) else {
                break;
            };
            while rest.fill_buf()?.first() == Some(&0) {
                rest.consume(1);
            }
            match rest.fill_buf()?.first() {
                None => {}
                Some(0x1f) => self.0 = Some(GzDecoder::new(rest)),
                Some(_) => {
                    return Err(damaged(
                        "there are bytes after the end of the compressed data",
                    ));
                }
            }
        }
        Ok(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::read::GzEncoder;

    /// Longer than the sample.
    fn text() -> String {
        let rows = (0..40_000).map(|n| format!("1,{n},0.5 µN\n"));
        "id1,id2,force\n".to_owned() + &rows.collect::<String>()
    }

    fn all(bytes: &[u8]) -> Vec<u8> {
        Input::open(bytes, None, None).unwrap().bytes().unwrap()
    }

    #[test]
    fn compressed_files_are_read_as_their_content() {
        let text = text();
        let bytes = text.as_bytes();
        let (begin, end) = bytes.split_at(100_000);
        let gzip = |bytes: &[u8]| {
            let mut packed = Vec::new();
            let mut encoder = GzEncoder::new(bytes, Compression::fast());
            encoder.read_to_end(&mut packed).unwrap();
            packed
        };
        for packed in [
            gzip(bytes),
            // Two files may be written one after the other.
            [gzip(begin), gzip(end)].concat(),
            [gzip(begin), vec![0; 100_000], gzip(end), vec![0]].concat(),
        ] {
            assert!(packed.len() < bytes.len() / 2);
            assert!(all(&packed) == bytes);
        }
        let more = [gzip(bytes), b"\n".to_vec()].concat();
        let read = Input::open(&*more, None, None).and_then(Input::bytes);
        let said = "there are bytes after the end of the compressed data";
        assert!(matches!(read, Err(Error::Io(error)) if error.to_string() == said));
        let cut = gzip(bytes);
        let cut = cut.get(..cut.len() / 2).unwrap();
        let read = Input::open(cut, None, None).and_then(Input::bytes);
        assert!(matches!(read, Err(Error::Io(_))));
    }

    #[test]
    fn files_without_end_are_not_kept() {
        let endless = Input::open(io::repeat(b'<'), None, Some(1 << 20)).unwrap();
        let refused = endless.bytes().unwrap_err().to_string();
        assert!(
            refused.contains("more than 1048576 bytes of a file"),
            "{refused}"
        );
        let all = Input::open(&[b'<'; 1 << 10][..], None, Some(1 << 10)).unwrap();
        assert_eq!(all.bytes().unwrap().len(), 1 << 10);
        let endless = Input::open(io::repeat(b'1'), Some(TextEncoding::Utf16Le), Some(1 << 20));
        assert!(endless.is_err());
    }

    #[test]
    fn utf_16_is_read_with_and_without_a_byte_order_mark() {
        let text = text();
        for (mark, to_bytes) in [
            (true, u16::to_le_bytes as fn(u16) -> [u8; 2]),
            (true, u16::to_be_bytes),
            (false, u16::to_le_bytes),
            (false, u16::to_be_bytes),
        ] {
            let mark = mark.then_some(0xfeff);
            let units = mark.into_iter().chain(text.encode_utf16());
            let bytes: Vec<u8> = units.flat_map(to_bytes).collect();
            assert!(all(&bytes) == text.as_bytes(), "{mark:?}");
        }
    }
}

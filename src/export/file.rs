//! Files that are whole or not there.

use std::fs;
use std::io::{BufWriter, Write};
use std::path::Path;

use super::WriteError;

/// Writes a file aside, and renames it into place when it is complete: a failure leaves what was there.
///
/// What is not a regular file, such as a pipe or a device, is written directly. A link is followed.
///
/// # Errors
/// Those of `write`, and [`WriteError::Io`].
///
/// # Examples
/// ```
/// use cannonpile::export::write_aside;
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("base.csv");
/// write_aside(&path, |out| Ok(out.write_all(b"i,j\n")?))?;
/// assert_eq!(std::fs::read(&path)?, b"i,j\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_aside(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if target.exists() && !target.is_file() {
        let mut out = BufWriter::new(fs::OpenOptions::new().write(true).open(&target)?);
        write(&mut out)?;
        return Ok(out.flush()?);
    }
    let folder = match target.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let mut aside = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any new file, not private as temporary files are; the umask still applies.
        aside.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut aside = aside.prefix(".cannonpile-").tempfile_in(folder)?;
    let mut out = BufWriter::new(aside.as_file_mut());
    write(&mut out)?;
    out.flush()?;
    drop(out);
    aside.persist(&target).map_err(|error| error.error)?;
    Ok(())
}

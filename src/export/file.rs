//! Files that are whole or not there.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::WriteError;

/// Writes a file aside, and renames it into place when it is complete: a failure leaves what was there.
///
/// What is not a regular file, such as a pipe or a device, is written directly. A link is followed, one to
/// nowhere and a read-only file refused; a file that is replaced hands on its permissions. Killed on the way, a
/// hidden file `.cannonpile-…` is left in the folder.
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
    let target = match fs::canonicalize(path) {
        Ok(target) => target,
        // A link to nowhere would be replaced, not followed.
        Err(error) if path.is_symlink() => return Err(error.into()),
        Err(_) => path.to_owned(),
    };
    let permissions = fs::metadata(&target)
        .ok()
        .map(|metadata| metadata.permissions());
    if permissions.as_ref().is_some_and(fs::Permissions::readonly) {
        return Err(io::Error::from(io::ErrorKind::PermissionDenied).into());
    }
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
    if let Some(permissions) = permissions {
        aside.as_file().set_permissions(permissions)?;
    }
    aside.persist(&target).map_err(|error| error.error)?;
    Ok(())
}

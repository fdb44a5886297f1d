//! Files that are complete or absent.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::error::WriteError;
use super::unfinished::{PREFIX, Pending};

/// Writes a file under a temporary name, and renames it when it is complete. A failure leaves an existing file
/// unchanged.
///
/// Symbolic links are followed, also to a file that does not exist yet. Pipes, devices and the files that a process has
/// open (`/dev/stdout`, `/dev/fd/3`) are written where they are, and not replaced. A read-only file is an error. The new
/// file inherits the permissions of the file that it replaces.
///
/// An interrupted process can [remove](super::remove_unfinished) its temporary files. A killed process (SIGKILL) leaves
/// hidden files `.cannonpile-…` in the folder.
///
/// # Errors
/// The errors of `write`, and [`WriteError::Io`].
///
/// # Examples
/// ```
/// use cannonpile_dem::table::write_aside;
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
    Aside::write(path, write)?.keep()?;
    Ok(())
}

/// A temporary file that has not been renamed to its path.
#[derive(Debug)]
pub(crate) struct Aside {
    /// `None` for a target that must be written directly.
    file: Option<(NamedTempFile, Pending)>,
    target: PathBuf,
    bytes: u64,
}

impl Aside {
    /// Writes a temporary file into the folder of the target. Dropping it removes the file.
    pub(crate) fn write(
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
    ) -> Result<Self, WriteError> {
        let target = followed(path)?;
        let descriptor = descriptor(&target);
        let permissions = fs::metadata(&target)
            .ok()
            .map(|metadata| metadata.permissions());
        if permissions.as_ref().is_some_and(fs::Permissions::readonly) {
            return Err(io::Error::from(io::ErrorKind::PermissionDenied).into());
        }
        if descriptor.is_some() || target.exists() && !target.is_file() {
            let bytes = match descriptor {
                Some(STDOUT) => write_to(io::stdout().lock(), write)?,
                Some(STDERR) => write_to(io::stderr().lock(), write)?,
                _ => write_to(fs::OpenOptions::new().append(true).open(&target)?, write)?,
            };
            let file = None;
            return Ok(Self {
                file,
                target,
                bytes,
            });
        }
        let folder = match target.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let mut aside = tempfile::Builder::new();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // Temporary files are private, but the result has the permissions of any new file; the umask still applies.
            aside.permissions(fs::Permissions::from_mode(0o666));
        }
        let (mut aside, pending) = Pending::create(
            || aside.prefix(PREFIX).tempfile_in(folder),
            |aside| aside.path().to_path_buf(),
        )?;
        let bytes = write_to(aside.as_file_mut(), write)?;
        if let Some(permissions) = permissions {
            aside.as_file().set_permissions(permissions)?;
        }
        Ok(Self {
            file: Some((aside, pending)),
            target,
            bytes,
        })
    }

    /// Renames the temporary file to its path, and returns its size in bytes.
    pub(crate) fn keep(self) -> io::Result<u64> {
        if let Some((file, pending)) = self.file {
            pending.complete(|| file.persist(&self.target).map_err(|error| error.error))?;
        }
        Ok(self.bytes)
    }

    /// Returns the target, with links resolved.
    pub(crate) fn target(&self) -> &Path {
        &self.target
    }
}

const STDOUT: u32 = 1;
const STDERR: u32 = 2;

/// Follows symbolic links, also to a file that does not exist. A link to an open file of the process is not followed.
fn followed(path: &Path) -> io::Result<PathBuf> {
    const MOST: u32 = 40;
    let mut target = path.to_owned();
    for _ in 0..MOST {
        match fs::read_link(&target) {
            Ok(link) if descriptor(&target).is_none() => target = target.with_file_name(link),
            _ => return Ok(target),
        }
    }
    // The system has the name of the error.
    fs::canonicalize(path)
}

/// Returns the number of the open file of this process that a path such as `/dev/fd/1` names.
fn descriptor(path: &Path) -> Option<u32> {
    let folder = fs::canonicalize(path.parent()?).ok()?;
    let own = ["/proc/self/fd", "/dev/fd"].map(|own| fs::canonicalize(own).ok());
    let number = path.file_name()?.to_str()?.parse();
    number.ok().filter(|_| own.contains(&Some(folder)))
}

fn write_to(
    out: impl Write,
    write: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<u64, WriteError> {
    let mut out = Counted {
        out: BufWriter::new(out),
        bytes: 0,
    };
    write(&mut out)?;
    out.flush()?;
    Ok(out.bytes)
}

/// A writer that counts bytes.
struct Counted<W> {
    out: W,
    bytes: u64,
}

impl<W: Write> Write for Counted<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

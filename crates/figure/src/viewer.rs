//! The interactive HTML viewer of a pile.

mod document;
mod encoding;
mod parts;
mod places;
mod quantity;
mod states;

use std::io::Write;

use cannonpile::Packing;
use cannonpile_dem::card::heading;
use cannonpile_dem::table::WriteError;
use cannonpile_dem::{CardTitle, NumberedPile};

use crate::Error;

/// An HTML viewer of a pile: one file, which a browser opens offline.
///
/// The viewer draws the spheres and contacts. A reader can rotate the pile, cut it at a layer, and select spheres and
/// contacts. For the selection it shows the exact forces, the correctly rounded floats and the neighbours.
///
/// If the pile has horizontal forces, or the title names the elastic state, the viewer also shows the isostatic state. The
/// drawing needs WebGL2. Without it the viewer still shows the table.
///
/// The file loads no other resource, and its content security policy forbids loading any. All texts are data, so none
/// of them can become markup.
///
/// # Examples
/// ```
/// use cannonpile_figure::viewer::Page;
/// use cannonpile::lattice::Region;
/// use cannonpile::{Packing, Pile};
///
/// let pile = Pile::under(Region::hexagon(3, 3)?, "+-+".parse()?)?;
/// let page = Page::new(&Packing::new(&pile, &"6/5".parse()?)?)?.to_html()?;
/// assert!(page.starts_with("<!doctype html>"));
/// assert!(page.contains("A pile of 131 spheres in 4 layers"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Page<'p> {
    pile: NumberedPile<'p>,
    title: CardTitle,
    scene: Option<String>,
}

impl<'p> Page<'p> {
    /// The largest number of spheres of a viewer.
    pub const MAX_SPHERES: u32 = 100_000;

    /// Returns the viewer of this pile.
    ///
    /// # Errors
    /// [`Error::TooManyGlyphs`] for more than [`MAX_SPHERES`](Self::MAX_SPHERES).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_figure::viewer::Page;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(84)?;
    /// let refused = Page::new(&Packing::new(&pile, &"6/5".parse()?)?);
    /// assert!(refused.unwrap_err().to_string().starts_with("102340 spheres are too many"));
    /// # Ok::<(), cannonpile_figure::Error>(())
    /// ```
    pub fn new(packing: &Packing<'p>) -> Result<Self, Error> {
        check(packing)?;
        Ok(Self {
            pile: NumberedPile::new(packing)?,
            title: CardTitle::default(),
            scene: None,
        })
    }

    /// Sets the title, the purpose and the state of the pile, as on a benchmark card.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::CardTitle;
    /// use cannonpile_figure::viewer::Page;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(4)?;
    /// let page = Page::new(&Packing::new(&pile, &"6/5".parse()?)?)?;
    /// let title = CardTitle { title: "</script> is a text".into(), ..CardTitle::default() };
    /// let page = page.with_title(title).to_html()?;
    /// assert!(page.contains(r"\u003c/script> is a text"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_title(self, title: CardTitle) -> Self {
        Self { title, ..self }
    }

    /// Adds the text of the scene file, `scene.toml`, which the viewer displays.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_figure::viewer::Page;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(4)?;
    /// let page = Page::new(&Packing::new(&pile, &"6/5".parse()?)?)?;
    /// let page = page.with_scene("layers = 4\n".into()).to_html()?;
    /// assert!(page.contains(r"layers = 4\n"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_scene(self, toml: String) -> Self {
        let scene = Some(toml);
        Self { scene, ..self }
    }

    /// Writes the file.
    ///
    /// # Errors
    /// [`WriteError::Answer`] with [`Overflow`](cannonpile::Error::Overflow) if a number does not fit in an `f64`, or with
    /// [`TooLarge`](cannonpile::Error::TooLarge) if the exact forces have too many digits; [`WriteError::Io`] if writing fails.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_figure::viewer::Page;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(5)?;
    /// let page = Page::new(&Packing::new(&pile, &"6/5".parse()?)?)?;
    /// let mut html = Vec::new();
    /// page.write(&mut html)?;
    /// assert!(html.starts_with(b"<!doctype html>"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write(&self, out: &mut dyn Write) -> Result<(), WriteError> {
        Ok(out.write_all(self.text()?.as_bytes())?)
    }

    /// Returns the file as a text.
    ///
    /// # Errors
    /// The errors of [`write`](Self::write), except those of the output.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_figure::viewer::Page;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(4)?;
    /// let page = Page::new(&Packing::new(&pile, &"6/5".parse()?)?)?.to_html()?;
    /// // The file loads nothing.
    /// assert!(page.contains("default-src 'none'") && !page.contains("http:") && !page.contains("https:"));
    /// # Ok::<(), cannonpile_figure::Error>(())
    /// ```
    pub fn to_html(&self) -> Result<String, Error> {
        Ok(self.text()?)
    }

    fn text(&self) -> Result<String, cannonpile_dem::Error> {
        let heading = heading(&self.pile, &self.title);
        let parts = parts::of(&self.pile, &self.title, &heading, self.scene.as_deref());
        Ok(document::text(&parts?))
    }
}

/// Checks that the pile has at most [`Page::MAX_SPHERES`] spheres.
fn check(packing: &Packing<'_>) -> Result<(), Error> {
    let glyphs = packing.pile().sphere_count();
    let limit = Page::MAX_SPHERES;
    if glyphs <= limit.into() {
        return Ok(());
    }
    Err(Error::TooManyGlyphs {
        glyphs,
        kind: "spheres",
        limit,
        remedy: "use fewer layers, a smaller top or base, or --to vtp for ParaView",
    })
}

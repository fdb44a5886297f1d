//! A page to look into a pile: one file of HTML.

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

/// A page to look into a pile: one file of HTML, which a browser opens without a network.
///
/// It draws the spheres and the contacts between them, which can be turned, cut at a layer and chosen; of what is chosen it
/// says the exact force, the nearest floats and the neighbours. Where a pile has horizontal forces, or the title says that its
/// state is the elastic one, the page shows the isostatic state beside it. It asks the browser for WebGL2; without, there is
/// a table.
///
/// Nothing is drawn from elsewhere, and the browser is told to refuse it. All texts are data, and none can be taken for
/// markup.
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
    /// The most spheres of a page.
    pub const MAX_SPHERES: u32 = 100_000;

    /// The page of this pile.
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

    /// The page with a title, and with what else a card says of the scene.
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

    /// The page with the text of the scene that the pile was made of, `scene.toml`, to be read on it.
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

    /// Writes the page.
    ///
    /// # Errors
    /// [`WriteError::Answer`] with [`Overflow`](cannonpile::Error::Overflow) if a number does not fit in an `f64`, with [`TooLarge`](cannonpile::Error::TooLarge) if the
    /// exact forces have too many digits; [`WriteError::Io`] if the output refuses.
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

    /// The page as a text.
    ///
    /// # Errors
    /// Those of [`write`](Self::write) that are answers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_figure::viewer::Page;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(4)?;
    /// let page = Page::new(&Packing::new(&pile, &"6/5".parse()?)?)?.to_html()?;
    /// // Nothing but itself.
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

/// Refuses a pile of more spheres than a page shows.
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

//! Contact tables in the formats of DEM codes.

use cannonpile::shape::Selection;
use cannonpile::{Error, Packing};
use cannonpile_dem::verify::{Measured, Preset};

/// The centres of the spheres as correctly rounded floats.
pub fn centres(packing: &Packing<'_>) -> Result<Vec<[f64; 3]>, Error> {
    let places = packing.positions(Selection::All)?;
    places
        .map(|place| Ok(place?.map(|x| x.nearest().unwrap_or_default())))
        .collect()
}

fn joined(numbers: &[f64]) -> String {
    let texts: Vec<String> = numbers.iter().map(|x| format!("{x:?}")).collect();
    texts.join(",")
}

/// A contact in the format of a code.
pub fn row(preset: Preset, measured: &Measured, centres: &[[f64; 3]]) -> String {
    let ([one, other], force) = (measured.ids, measured.force);
    let vector = measured.vector.unwrap();
    let [a, b] = [one, other].map(|id| centres[usize::try_from(id - 1).unwrap()]);
    let point = joined(&[0, 1, 2].map(|x: usize| a[x].midpoint(b[x])));
    // The code numbers the spheres in its own way.
    let [n, m] = [50 - one, 50 - other];
    match preset {
        Preset::Lammps => format!("{one},{other},{force:?},{}\n", joined(&vector)),
        Preset::Yade => format!("{},{},{force:?}\n", one - 1, other - 1),
        Preset::DemEngine => format!("SS,{n},{m},{},{point}\n", joined(&vector)),
        Preset::Mddem => format!("{one},{other},{:?},{point},0,0,1\n", force / 1024.0),
        Preset::Kratos => format!("{},{},{force:?}\n", joined(&a), joined(&b)),
        Preset::MercuryDpm => {
            let point = point.replace(',', " ");
            format!(
                "0.5 {} {} {point} 1e-6 0 {force:?} 0 0 0 1 0 0 0\n",
                one - 1,
                other - 1
            )
        }
        _ => {
            let minus = joined(&vector.map(|x| -x));
            let (a, b) = (joined(&a), joined(&b));
            format!("{n},{m},0,0,0,-1e-6,{point},{minus},0,0,0,{a},{b}\n")
        }
    }
}

/// The lines before the contacts, including a contact with a wall. `None` for a code that writes no tables.
pub fn head(preset: Preset) -> Option<&'static str> {
    Some(match preset {
        Preset::Lammps => "patom1,patom2,force,fx,fy,fz\n",
        Preset::Yade => "id1,id2,force\n",
        Preset::DemEngine => "contact_type,A,B,f_x,f_y,f_z,X,Y,Z\nSM,1,2,0,0,1,0,0,9\n",
        Preset::Mddem => "i_tag,j_tag,overlap,cx,cy,cz,nx,ny,nz\n",
        Preset::ExaDem => "0,0,0,0,5,-1,0,0,9,1,0,0,0,0,0,0,0,8,0,0,0\n",
        Preset::Kratos => "x1,y1,z1,x2,y2,z2,local_contact_force_z\n",
        Preset::MercuryDpm => "# 0.5 3\n# 0 0 0 10 10 10\n# 1 1 0 0 0 0\n",
        _ => return None,
    })
}

//! `pile.data` and `pile.in` for LAMMPS.

use std::io::Write;

use super::PileExport;
use super::progress::Progress;
use super::rounded::Centres;
use super::springs::{Springs, burdens, density, inertia, normal};
use crate::Error;
use crate::lattice::Dimension;
use crate::shape::Selection;
use crate::table::WriteError;

/// The most atoms of LAMMPS as it is usually compiled.
const MOST_ATOMS: u64 = i32::MAX as u64;

/// The spheres, those on the floor of type 2, in a box that leaves them room to fall.
pub(super) fn write_data(
    export: &PileExport<'_>,
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<(), WriteError> {
    let (pile, spheres) = (export.pile(), export.numbering.spheres());
    if spheres > MOST_ATOMS {
        return Err(Error::TooLarge {
            quantity: "the atoms of LAMMPS",
            needed: spheres.into(),
            limit: MOST_ATOMS,
            remedy: "use fewer layers, or a smaller top or base",
        }
        .into());
    }
    let springs = Springs::of(export)?;
    let layers = pile.layers();
    writeln!(
        out,
        "cannonpile: {spheres} spheres in {layers} layers, exact positions\n"
    )?;
    writeln!(out, "{spheres} atoms\n2 atom types\n")?;
    let margin = 4.0 * springs.radius;
    for (name, [least, greatest]) in ["x", "y", "z"].iter().zip(springs.bounds) {
        let (low, high) = (least - margin, greatest + margin);
        writeln!(out, "{low:?} {high:?} {name}lo {name}hi")?;
    }
    writeln!(out, "\nAtoms # sphere\n")?;
    let diameter = 2.0 * springs.radius;
    let ordinary = density(springs.mass, springs.radius)?;
    let mut centres = Centres::new(&export.packing);
    for (id, site) in (1_u64..).zip(pile.rows(Selection::All)?.flatten()) {
        let [x, y, z] = centres.of(site)?;
        let kind = if site.k + 1 == layers { 2 } else { 1 };
        let density = if pile.loading().is_ordinary(site) {
            ordinary
        } else {
            density(normal(&inertia(export, site)?, "mass")?, springs.radius)?
        };
        writeln!(
            out,
            "{id} {kind} {diameter:?} {density:?} {x:?} {y:?} {z:?}"
        )?;
        progress.row();
    }
    Ok(())
}

/// A script that lets the pile relax, and writes the forces of the last state.
pub(super) fn write_input(export: &PileExport<'_>, out: &mut dyn Write) -> Result<(), WriteError> {
    let springs = Springs::of(export)?;
    let Springs {
        stiffness,
        timestep,
        gravity,
        last_digit,
        most_steps,
        mass,
        radius,
        ..
    } = springs;
    // LAMMPS takes it by the mass of the pair, which is m/2.
    let damping = springs.dashpot() / (mass / 2.0);
    write!(
        out,
        "# cannonpile: relaxes pile.data and writes the forces of its contacts to forces.dump.
# Run in this folder: lmp -in pile.in (LAMMPS with the package GRANULAR).
# Frictionless spheres on springs; the exact pile is stiff, so forces differ by some 1e-6 of the greatest.

units           si
atom_style      sphere
atom_modify     map array
boundary        f f f
newton          off
comm_modify     vel yes
read_data       pile.data

group           floor type 2
group           mobile subtract all floor

# Force k*overlap, in N; no tangential force. Stiff for the weight of the pile, not too stiff for the digits of positions.
pair_style      gran/hooke {stiffness:?} NULL {damping:?} NULL 0.0 0
pair_coeff      * *
neighbor        {skin:?} bin
neigh_modify    delay 0 every 1 check yes

",
        skin = 0.2 * radius,
    )?;
    if gravity > 0.0 {
        writeln!(
            out,
            "fix             weight all gravity {gravity:?} vector 0 0 -1"
        )?;
    }
    write_loads(export, out)?;
    write!(
        out,
        "# Drag, which is gone when all is at rest.
fix             drag mobile viscous {drag:?}
fix             floor floor freeze
",
        drag = springs.drag(),
    )?;
    if export.pile().dimension() == Dimension::Two {
        writeln!(
            out,
            "# Discs stay in their plane.\nfix             plane all setforce NULL 0.0 NULL"
        )?;
    }
    write!(
        out,
        "fix             move mobile nve/sphere
timestep        {timestep:?}

# At rest: no sphere is pushed by more than, or moves by as much as, the last digit of a coordinate lets it know.
variable        net atom sqrt(fx*fx+fy*fy+fz*fz)
compute         net mobile reduce max v_net
compute         speed mobile reduce maxabs vx vy vz
variable        step equal {last_digit:?}/{timestep:?}
variable        slow equal (c_speed[1]<v_step)&&(c_speed[2]<v_step)&&(c_speed[3]<v_step)
variable        rest equal (c_net<{rest:?})&&v_slow
fix             stop all halt 100 v_rest > 0.5 error continue

thermo_style    custom step c_net c_speed[3] v_rest
# What falls off a pile that cannot stand leaves the box.
thermo_modify   lost ignore format float %.3e
thermo          1000
run             {most_steps}
unfix           stop

# Force on sphere id1; a positive one pushes.
compute         pairs all property/local patom1 patom2 cutoff radius
compute         forces all pair/local force fx fy fz cutoff radius
run             0
if \"$(v_rest) > 0.5\" then \"print 'cannonpile: the pile is at rest'\" &
                else \"print 'cannonpile: the pile is NOT at rest; run it longer, or it does not stand'\"
write_dump      all local forces.dump c_pairs[1] c_pairs[2] c_forces[1] c_forces[2] c_forces[3] c_forces[4] &
                modify colname 1 id1 colname 2 id2 colname 3 force colname 4 fx colname 5 fy colname 6 fz &
                format float %.17g
",
        rest = springs.rest(),
    )?;
    Ok(())
}

fn write_loads(export: &PileExport<'_>, out: &mut dyn Write) -> Result<(), WriteError> {
    let burdens = burdens(export)?;
    if burdens.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "# Loads, in N.\nfix             load all property/atom d_load"
    )?;
    for burden in burdens {
        let (id, force) = (burden.id, -burden.force);
        writeln!(out, "set             atom {id} d_load {force:?}")?;
    }
    writeln!(
        out,
        "variable        load atom d_load\nfix             push all addforce 0.0 0.0 v_load"
    )?;
    Ok(())
}

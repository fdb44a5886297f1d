//! The names of the theorems in Coq.

/// Returns the names of a theorem in Coq, each with its file. The list is empty for a theorem without a proof in
/// Coq.
pub(crate) fn in_coq(theorem: &str) -> &'static [&'static str] {
    let found = NAMES.iter().find(|(name, _)| *name == theorem);
    // Theorems outside the list have no proof in Coq.
    found.map_or(&[], |(_, names)| names)
}

/// The name of a theorem, and its names in Coq.
const NAMES: &[(&str, &[&str])] = &[
    ("counts", &["Straight.counts"]),
    ("rotation", &["Straight.rotation"]),
    (
        "spheres",
        &[
            "Floor.spheres_in_a_layer",
            "Floor.spheres_of_a_layer_are",
            "Floor.spheres_of_a_pile",
            "Floor.spheres_are",
        ],
    ),
    (
        "contacts",
        &[
            "Counts.contacts",
            "Counts.contacts_from_below",
            "Counts.contacts_are",
        ],
    ),
    (
        "strengths",
        &[
            "Counts.strengths",
            "Counts.strengths_in_all",
            "Counts.sum_of_strengths",
        ],
    ),
    (
        "paper-system",
        &[
            "Balance.paper_system",
            "Balance.increments_solve",
            "Balance.determinant",
            "Balance.newton",
        ],
    ),
    (
        "unit-directions",
        &["Balance.unit_directions", "Balance.gram_form"],
    ),
    (
        "equilibrium",
        &[
            "Balance.every_sphere_is_in_balance_under",
            "Balance.supports_push_back",
            "Straight.closed_form_is_the_only_solution",
            "Straight.straight_piles_stand",
        ],
    ),
    ("surface", &["Straight.surface"]),
    ("action-reaction", &["Straight.action_reaction"]),
    ("central-force", &["Floor.central_force"]),
    (
        "half-turn",
        &[
            "Balance.half_turn_is",
            "Balance.half_turn_keeps_lengths",
            "Balance.half_turn_is_symmetric",
            "Balance.half_turn_twice",
            "Balance.half_turn_of_ones",
        ],
    ),
    (
        "base-normal",
        &["Floor.base_normal", "Floor.base_normal_equilateral"],
    ),
    (
        "uniform-base",
        &[
            "Floor.difference_of_normals",
            "Floor.uniform_if_and_only_if",
        ],
    ),
    (
        "weight",
        &["Floor.on_floor_is_what_arrives", "Floor.the_weight_arrives"],
    ),
    ("shear", &["Floor.shear"]),
    ("total-shear", &["Floor.total_shear"]),
    (
        "total-moment",
        &["Floor.no_moment_about_the_axis", "Floor.total_moment"],
    ),
    ("second-moment", &["Floor.second_moment"]),
    (
        "shear-on-axis",
        &[
            "Floor.shear_is_the_place",
            "Floor.shear_vanishes_on_the_axis",
        ],
    ),
    (
        "shear-ratio",
        &[
            "Floor.shear_ratio",
            "Floor.shear_is_greatest_in_the_corners",
        ],
    ),
    (
        "discs",
        &[
            "Counts.newton_of_discs",
            "Counts.discs_are_in_balance",
            "Counts.disc_base",
            "Counts.discs_weigh",
        ],
    ),
    (
        "dimensions",
        &[
            "Counts.balance_in_any_dimension",
            "Counts.weight_in_dimensions",
            "Counts.normal_in_any_dimension",
            "Counts.spheres_in_dimension_2",
            "Counts.spheres_in_dimension_3",
            "Counts.spheres_in_dimension_4",
            "Counts.spheres_in_dimension_5",
            "Counts.spheres_in_dimension_6",
            "Counts.spheres_in_dimensions",
            "Counts.spheres_in_any_dimension",
            "Counts.weight_arrives_in_dimensions",
        ],
    ),
    (
        "region-counts",
        &["Regions.region_counts", "Regions.region_of_the_paper"],
    ),
    ("run", &["Regions.run", "Regions.run_in_any_order"]),
    (
        "tripled-half-turn",
        &["Balance.tripled", "Balance.tripled_integers"],
    ),
    (
        "change-of-sign",
        &[
            "Balance.change_of_sign",
            "Balance.newton_in_any_stacking",
            "Stackings.recursion_is_the_only_solution",
        ],
    ),
    (
        "edge",
        &[
            "Regions.edges",
            "Stackings.the_end_of_a_run_pulls",
            "Stackings.no_run_of_five_can_end",
            "Census.census",
            "Census.mirror_image",
            "Census.census_at_any_height",
            "Census.how_many_stand",
        ],
    ),
    (
        "point-load",
        &[
            "Response.load_is_kept",
            "Response.response_is_centred",
            "Response.second_moment_of_response",
            "Response.point_load",
            "Response.forces_under_weights",
            "Virtual.the_weight_arrives_beside",
            "Response.first_moment_arrives",
            "Response.second_moment_arrives",
            "Balance.half_turn_is_linear",
        ],
    ),
    (
        "load",
        &[
            "Loads.loaded_sphere",
            "Loads.loaded_sphere_in_any_stacking",
            "Loads.loaded_disc",
            "Loads.vertical_load",
            "Loads.mirrored_load",
            "Loads.loads_add",
            "Loads.loads_determine_forces",
        ],
    ),
    (
        "tilt",
        &[
            "Loads.closed_form_under_tilt_is_the_only_solution",
            "Loads.forces_are_multiples",
            "Loads.straight_pile_bears",
            "Loads.nearest_tilt",
            "Loads.margin_is_borne",
            "Loads.margin_is_sharp",
            "Loads.critical_tilt",
            "Loads.critical_tilt_of_discs",
        ],
    ),
    (
        "tilt-total",
        &[
            "Loads.on_floor_under_tilt_is_what_arrives",
            "Loads.total_under_tilt",
            "Loads.moment_under_tilt",
        ],
    ),
    (
        "horizontal-balance",
        &[
            "Horizontal.neighbours_touch",
            "Horizontal.horizontal_balance",
            "Virtual.closed_form_is_balanced_beside",
        ],
    ),
    (
        "virtual-work",
        &[
            "Horizontal.work_of_a_sphere",
            "Horizontal.work_of_a_sloping_contact",
            "Horizontal.work_of_a_horizontal_contact",
            "Virtual.work_on_the_floor",
            "Virtual.virtual_work",
            "Virtual.at_most_the_weights",
            "Virtual.at_least_the_weights",
            "Virtual.the_weight_arrives_beside",
        ],
    ),
    (
        "elastic-straight",
        &[
            "Horizontal.field_on_the_floor",
            "Horizontal.field_lowers_by_the_force",
            "Horizontal.field_opens",
            "Horizontal.field_of_discs",
            "Virtual.energy_of_a_state",
            "Virtual.closed_form_is_the_elastic_state",
            "Virtual.elastic_state_is_unique",
        ],
    ),
    (
        "elastic-energy",
        &["Horizontal.elastic_energy", "Horizontal.energy_is_work"],
    ),
    ("settlement", &["Horizontal.settlement"]),
    ("elastic-monotone", &["Regions.monotone"]),
    ("no-dip", &["Regions.no_dip"]),
    (
        "corner-least",
        &[
            "Horizontal.corner_least",
            "Bounds.least_on_a_corner",
            "Bounds.least_is_reached",
        ],
    ),
    (
        "corner-greatest",
        &[
            "Horizontal.corner_greatest",
            "Horizontal.greatest_is_attained",
            "Horizontal.neighbour_of_the_edge",
            "Bounds.greatest_on_a_corner",
            "Bounds.edge_pushes_balance",
            "Bounds.greatest_is_reached",
        ],
    ),
    (
        "arch",
        &[
            "Horizontal.arch_empties",
            "Horizontal.flank",
            "Horizontal.steep_arch",
            "Horizontal.arch_pushes",
        ],
    ),
    (
        "inner-greatest",
        &[
            "Horizontal.inner_greatest",
            "Horizontal.greatest_at_a_centre",
            "Bounds.greatest_on_any_sphere",
        ],
    ),
    (
        "edge-greatest",
        &[
            "Horizontal.edge_greatest",
            "Horizontal.edge_greatest_is",
            "Bounds.greatest_on_an_edge_for",
            "Bounds.greatest_on_an_edge",
        ],
    ),
    (
        "run-horizontal",
        &[
            "Horizontal.run_with_pushes",
            "Horizontal.no_run_ends_with_pushes",
        ],
    ),
    (
        "resultant-form",
        &["Response.resultant_form", "Balance.half_turn_twice"],
    ),
    (
        "squares",
        &[
            "Response.sums_and_squares",
            "Response.squares_in_any_stacking",
            "Response.sums_and_squares_of_piles",
        ],
    ),
    (
        "third-moment",
        &[
            "Response.third_moment_of_response",
            "Mean.mean_of_third_moment",
            "Mean.mean_of_sign",
            "Mean.third_moment_of_random_stackings",
        ],
    ),
    (
        "fourth-moment",
        &[
            "Response.fourth_moment_of_response",
            "Mean.mean_of_fourth_moment",
            "Mean.mean_of_two_signs",
            "Mean.fourth_moment_of_random_stackings",
        ],
    ),
    (
        "mean-modes",
        &["Mean.modes_of_the_mean", "Mean.staggered_mode"],
    ),
    (
        "mean-spectrum",
        &[
            "Spectrum.spectrum_of_the_mean",
            "Spectrum.waves_run",
            "Spectrum.waves_across_decay",
        ],
    ),
    ("wave", &["Response.wave_of_hcp"]),
    (
        "faults",
        &[
            "Response.fault",
            "Response.load_is_kept",
            "Response.few_faults",
        ],
    ),
    ("one-fault", &["Response.one_fault"]),
    ("registry", &["Mean.registry", "Mean.registry_at_the_top"]),
];

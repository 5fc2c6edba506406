//! Values of the right kind that mean nothing, and starts that cannot be made.

use super::Slip;

pub(super) const MEANINGS: &[Slip] = &[
    (
        "fabric = \"c\"",
        "fabric = \"silk\"",
        &["cloth.fabric is \"silk\"; allowed: a, b, c, d, washi"],
    ),
    (
        "fabric = \"c\"",
        "fabric = \"whashi\"",
        &["did you mean \"washi\"?"],
    ),
    (
        "point_cm = [-10.0, 10.0]",
        "edge = \"left\"",
        &["hold[1].edge is \"left\"; allowed: \"x-min\", \"x-max\", \"y-min\", \"y-max\""],
    ),
    (
        "point_cm = [-10.0, 10.0]",
        "edge = \"x-min\"\nclamp = 1",
        &["hold[1].clamp is 1; allowed: true or false"],
    ),
    (
        "point_cm = [-10.0, 10.0]",
        "point_cm = [-30.0, 10.0]",
        &["hold[1].point_cm is [-30.0, 10.0]", "outside the cloth"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "outline_cm = [[-20, -20], [20, -20], [20, 20], [-20, 20]]\nholes_cm = [[[-15, 5], [-5, 5], [-5, 15], [-15, 15]]]",
        &["hold[1].point_cm is [-10.0, 10.0]", "outside the cloth"],
    ),
    (
        "max_seconds = 60.0",
        "forces = \"newton\"",
        &["solve.forces is \"newton\"; allowed: \"lattice\", \"paper\""],
    ),
    (
        "max_seconds = 60.0",
        "laws = [\"tension\", \"twist\"]",
        &["solve.laws[2] is \"twist\"; allowed: \"tension\", \"bending\", \"shear\""],
    ),
    (
        "max_seconds = 60.0",
        "laws = []",
        &["solve.laws is []; allowed: one or more"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "mesh = { file = \"x.obj\", unit = \"km\" }",
        &["body[1].mesh.unit is \"km\"; allowed: \"m\", \"cm\", \"mm\", \"in\""],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "mesh = { file = \"x.obj\", unit = \"m\", up = \"x\" }",
        &["body[1].mesh.up is \"x\"; allowed: \"y\", \"z\""],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "mesh = { file = \"x.obj\", unit = \"m\", scale = 0 }",
        &["body[1].mesh.scale is 0; allowed"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "outline_cm = [[0, 0], [10, 0]]",
        &["cloth.outline_cm: ", "at least 3"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "outline_cm = [[0, 0], [10, 0], [20, 0]]",
        &["cloth.outline_cm: ", "no area"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "outline_cm = [[0, 0], [10, 10], [10, 0], [0, 10]]",
        &["cloth.outline_cm: ", "crosses itself"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "outline_cm = [[0, 0], [10, 0], [10, 10, 10]]",
        &["cloth.outline_cm[3] is [10, 10, 10]; allowed: a list of 2 numbers"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "outline_cm = [[0, 0], [20, 0], [0, 20]]\nholes_cm = [[[50, 50], [51, 50], [50, 51]]]",
        &["hole 1 lies outside the outline"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "outline_cm = [[0, 0], [20, 0], [0, nan]]",
        &["cloth.outline_cm[3][2] is nan; allowed"],
    ),
    (
        "size_cm = [20.0, 20.0]\nspacing_cm = 2.0",
        "disc_radius_cm = 0.5\nspacing_cm = 20.0",
        &["cloth.spacing_cm is 20.0", "at least 4 are needed"],
    ),
    (
        "centre_cm = [0.0, 0.0, 25.0]",
        "centre_cm = [0.0, 0.0, 6.0]",
        &[
            "cloth.centre_cm is [0.0, 0.0, 6.0]",
            "starts inside",
            "body 1",
        ],
    ),
    (
        "ball = { radius_cm = 10.0 }\nat_cm = [0.0, 0.0, 5.0]",
        "name = \"floor\"\ncuboid = { size_cm = [200, 200, 10] }\nat_cm = [0, 0, 21]",
        &["starts inside", "floor"],
    ),
    (
        "[[hold]]\npoint_cm = [-10.0, 10.0]\n[[body]]\nball = { radius_cm = 10.0 }\nat_cm = [0.0, 0.0, 5.0]\n",
        "",
        &["nothing carries the cloth"],
    ),
    (
        "[[hold]]\npoint_cm = [-10.0, 10.0]\n[[body]]\nball = { radius_cm = 10.0 }\nat_cm = [0.0, 0.0, 5.0]\n",
        "[[body]]\nball = { radius_cm = 10.0 }\nat_cm = [21.0, 0.0, 5.0]\n",
        &["nothing carries the cloth", "[[body]] below it"],
    ),
    (
        "[[hold]]\npoint_cm = [-10.0, 10.0]\n[[body]]\nball = { radius_cm = 10.0 }\nat_cm = [0.0, 0.0, 5.0]\n",
        "[[body]]\nball = { radius_cm = 10.0 }\nat_cm = [0.0, 0.0, 45.0]\n",
        &["nothing carries the cloth", "[[body]] below it"],
    ),
];

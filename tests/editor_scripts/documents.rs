//! Documents of every kind that commands and tools meet.

use std::io::Cursor;
use std::sync::Arc;

use batten::document::{Curve, CurveId, Document, Edit, EndMatch, MatchPlace, Reference};
use batten::geometry::end_correction::EndTarget;
use batten::geometry::expressions::LengthUnit;
use batten::geometry::{Continuity, End, Mirror, Symmetry};
use batten::io::{FileMatch, MatchSource, PICTURE};
use glam::DVec3;
use image::{GrayImage, ImageFormat, Luma};

use super::common::Kind;
use super::events::{Event, Player};
use super::window::{OfCurve, Panel};

/// A document of the matrix: its name, its curves, and the number of the active one.
pub struct Case {
    /// What it is an example of.
    pub name: &'static str,
    curves: Vec<Curve>,
    matches: Vec<FileMatch>,
    references: Vec<Reference>,
    active: usize,
}

impl Case {
    fn new(name: &'static str, curves: Vec<Curve>) -> Self {
        let active = 0;
        Self {
            name,
            curves,
            matches: Vec::new(),
            references: Vec::new(),
            active,
        }
    }

    /// Let ends of the first curve follow the second: its start a point, its end an end.
    fn with_matches(self) -> Self {
        let matched = |end, place, continuity| FileMatch {
            curve: 0,
            end,
            source: MatchSource::Curve(1),
            place,
            continuity,
            reversed: false,
        };
        let point = MatchPlace::Parameter(1.25);
        let matches = vec![
            matched(End::Start, point, Continuity::G1),
            matched(End::Finish, MatchPlace::End(End::Start), Continuity::G2),
        ];
        Self { matches, ..self }
    }

    /// Put a picture behind the curves.
    fn with_picture(self) -> Self {
        let references = vec![picture()];
        Self { references, ..self }
    }

    fn with_active(self, active: usize) -> Self {
        Self { active, ..self }
    }

    /// Open the document, make two steps and take one back, so that undo and redo have something
    /// to do, and activate a curve.
    pub fn open(&self) -> Result<Player, String> {
        let document = Document::from_curves(self.curves.clone());
        let document = document.with_references(self.references.clone());
        let ids: Vec<CurveId> = document.ids().collect();
        // Matches that are set are met, as far as they can be.
        let matched = |matched: &FileMatch| match matched.source {
            MatchSource::Curve(source) => Some(Edit::SetMatch(EndMatch {
                curve: ids[matched.curve],
                end: matched.end,
                source: ids[source],
                place: matched.place,
                continuity: matched.continuity,
                reversed: matched.reversed,
            })),
            MatchSource::Reference(_) => None,
        };
        let document = document.edited(self.matches.iter().filter_map(matched));
        let mut player = Player::new(document.map_err(|error| error.to_string())?);
        player.play(&[
            Event::Panel(Panel::OfCurve(0, OfCurve::Rename("renamed"))),
            Event::Panel(Panel::OfCurve(0, OfCurve::Recolour(Some([1, 2, 3])))),
            Event::Command(batten::editor::Command::Undo),
            Event::Panel(Panel::OfCurve(self.active, OfCurve::Activate)),
        ])?;
        Ok(player)
    }
}

/// One document of every kind.
pub fn cases() -> Vec<Case> {
    let [planar, spatial, rational, periodic] = [
        Kind { seed: 1, ..PLANAR },
        Kind {
            in_space: true,
            seed: 2,
            ..PLANAR
        },
        Kind {
            rational: true,
            seed: 3,
            ..PLANAR
        },
        Kind {
            periodic: true,
            seed: 4,
            ..PLANAR
        },
    ]
    .map(curve);
    let single = curve(Kind {
        degree: 4,
        extra: 0,
        seed: 5,
        ..PLANAR
    });
    let all = curve(Kind {
        rational: true,
        in_space: true,
        periodic: true,
        seed: 6,
        ..PLANAR
    });
    let hidden = Curve {
        visible: false,
        ..with_targets(spatial.clone())
    };
    let locked = Curve {
        locked: true,
        ..with_targets(rational.clone())
    };
    let [planar_again, planar_too, rational_too] =
        [planar.clone(), planar.clone(), rational.clone()];
    let oval = curve(Kind {
        periodic: true,
        extra: 4,
        seed: 4,
        ..PLANAR
    });
    let along = DVec3::new(3.0, 4.0, 0.0);
    let slanted = Mirror::through(DVec3::X, along).expect("a line");
    let several = vec![
        planar.clone(),
        with_targets(spatial.clone()),
        periodic.clone(),
    ];
    let matched = vec![
        planar.clone(),
        with_targets(rational.clone()),
        hidden.clone(),
    ];
    vec![
        Case::new("matched, the follower active", matched.clone()).with_matches(),
        Case::new("matched, the source active", matched)
            .with_matches()
            .with_active(1),
        Case::new("planar", vec![planar.clone()]),
        Case::new("spatial", vec![spatial]),
        Case::new("rational", vec![rational.clone()]),
        Case::new("periodic", vec![periodic]),
        Case::new("periodic, rational, spatial", vec![all]),
        Case::new("single segment", vec![single]),
        Case::new("with targets", vec![with_targets(planar.clone())]),
        Case::new("several, the second active", several).with_active(1),
        Case::new("beside a hidden one", vec![planar.clone(), hidden.clone()]),
        Case::new(
            "with locked vertices",
            vec![with_locks(with_targets(planar.clone()))],
        ),
        Case::new(
            "rational with locked vertices",
            vec![with_locks(rational.clone())],
        ),
        Case::new("beside a locked one", vec![planar.clone(), locked.clone()]),
        Case::new("locked and active", vec![planar.clone(), locked]).with_active(1),
        Case::new("hidden and active", vec![planar, hidden]).with_active(1),
        Case::new("before a picture", vec![planar_again.clone()]).with_picture(),
        Case::new("a picture, active", vec![planar_again])
            .with_picture()
            .with_active(1),
        Case::new(
            "symmetric, with locks",
            vec![symmetric(with_locks(symmetric(with_targets(
                planar_too.clone(),
            ))))],
        ),
        Case::new("an oval with two axes", vec![symmetric(oval)]),
        with_one_match(Case::new(
            "symmetric about a slanted axis, following",
            vec![
                symmetric_about(&planar_too, slanted),
                with_targets(rational_too),
            ],
        )),
        Case::new("empty", Vec::new()),
    ]
}

/// Make a curve stay symmetric about the y axis, where it lies; a closed one about both axes if it can be.
pub fn symmetric(curve: Curve) -> Curve {
    symmetric_about(&curve, Mirror::of_coordinate(0))
}

fn symmetric_about(curve: &Curve, mirror: Mirror) -> Curve {
    let both = Symmetry::about_both(mirror, &curve.polygon);
    let symmetry = both.unwrap_or_else(|| Symmetry::about(mirror, &curve.polygon));
    curve.with_symmetry(symmetry).expect("a symmetric curve")
}

/// Let only the start of the first curve follow the second.
fn with_one_match(case: Case) -> Case {
    let case = case.with_matches();
    let matches = case.matches.into_iter().take(1).collect();
    Case { matches, ..case }
}

/// An embedded picture of a few pixels.
pub fn picture() -> Reference {
    let mut bytes = Cursor::new(Vec::new());
    let pixels = GrayImage::from_fn(9, 7, |x, y| Luma([(16 * (x + y)) as u8]));
    pixels
        .write_to(&mut bytes, ImageFormat::Png)
        .expect("a picture");
    let reading = PICTURE.read(bytes.get_ref()).expect("a picture");
    let mut references = reading.references.into_iter();
    Arc::unwrap_or_clone(references.next().expect("a frame"))
}

/// A document of another program: two curves, the first of which may follow the second.
#[derive(Clone, Copy, Debug)]
pub struct Foreign {
    /// Its unit.
    pub unit: Option<LengthUnit>,
    /// What its curves are made of.
    pub seed: u64,
    /// How much of the second curve's end the first curve's start takes.
    pub follows: Option<Continuity>,
}

impl Foreign {
    /// Make the document.
    pub fn document(self) -> Document {
        let seeds = [self.seed, self.seed + 1];
        let curves = seeds.map(|seed| curve(Kind { seed, ..PLANAR }));
        let document = Document::from_curves(curves).with_unit(self.unit);
        let ids: Vec<CurveId> = document.ids().collect();
        let matched = self.follows.map(|continuity| {
            Edit::SetMatch(EndMatch {
                curve: ids[0],
                end: End::Start,
                source: ids[1],
                place: MatchPlace::End(End::Finish),
                continuity,
                reversed: false,
            })
        });
        let document = document.edited(matched);
        document.expect("a match of two open curves")
    }
}

const PLANAR: Kind = Kind {
    degree: 3,
    extra: 3,
    periodic: false,
    rational: false,
    in_space: false,
    seed: 0,
};

fn curve(kind: Kind) -> Curve {
    Curve::new(format!("curve {}", kind.seed), kind.polygon())
}

/// Lock the second and the last vertex of a curve.
fn with_locks(mut curve: Curve) -> Curve {
    let last = curve.polygon.vertices().len() - 1;
    curve.locked_vertices = [1, last].into_iter().collect();
    curve
}

/// Give a curve's ends targets that it misses.
pub fn with_targets(mut curve: Curve) -> Curve {
    for end in End::BOTH {
        let jet = curve.polygon.end_jet(end);
        let target = EndTarget {
            point: jet.point + DVec3::new(1.5, -1.0, 0.0),
            direction: Some(DVec3::new(1.0, 2.0, 0.0)),
            ..EndTarget::default()
        };
        curve.targets.set(end, Some(target));
    }
    curve
}

//! How curvatures are written on screen: κ, the radius R, or both.

/// The ways to write a curvature.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CurvatureDisplay {
    /// κ alone.
    Curvature,
    /// The radius alone.
    Radius,
    /// κ with the radius beside it.
    #[default]
    Both,
}

impl CurvatureDisplay {
    /// Every way, in the order of the menu.
    pub const ALL: [Self; 3] = [Self::Curvature, Self::Radius, Self::Both];

    /// Its name in the settings.
    pub fn name(self) -> &'static str {
        match self {
            Self::Curvature => "curvature",
            Self::Radius => "radius",
            Self::Both => "both",
        }
    }

    /// Find a way by its name in the settings; `None` if there is none of this name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|it| it.name() == name)
    }

    /// Its name on screen.
    pub fn label(self) -> &'static str {
        match self {
            Self::Curvature => "Curvature as κ",
            Self::Radius => "Curvature as R",
            Self::Both => "Curvature as both",
        }
    }

    /// Whether κ is written.
    pub fn shows_curvature(self) -> bool {
        self != Self::Radius
    }

    /// Whether the radius is written.
    pub fn shows_radius(self) -> bool {
        self != Self::Curvature
    }
}

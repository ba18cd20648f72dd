//! The kinds of inputs that operations want.

/// What an operation works on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inputs {
    /// Nothing: the parameters tell all.
    None,
    /// A curve.
    One,
    /// A curve, or nothing where the parameters tell what to work on.
    OneOrNone,
    /// Two curves, in an order.
    Two,
    /// Up to two curves, in an order; the parameters tell what is not taken from them.
    UpToTwo,
    /// A table of points.
    Points,
    /// References: one that is chosen, or those of the document.
    References,
}

impl Inputs {
    /// Ask for what is missing, in words.
    pub(super) fn request(self) -> &'static str {
        match self {
            Self::None => "this works on no curve: choose none",
            Self::OneOrNone => "choose a curve, or give a reference",
            Self::One => "choose one curve",
            Self::Two => "choose two different curves",
            Self::UpToTwo => "choose no more than two different curves",
            Self::Points => "a table of points is needed",
            Self::References => {
                "there is no smooth reference, such as a spline of a drawing or a formula"
            }
        }
    }
}

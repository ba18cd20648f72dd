//! A plane of two parameters, of which every place is proved.

use super::parameter::Parameter;
use super::value::Value;
use super::values::Values;
use crate::geometry::mineur_farin;

/// Offer a plane of two parameters that is coloured by what is proved there, to choose both at once.
#[derive(Clone, Copy, Debug)]
pub struct Atlas {
    /// What is proved, and where.
    pub plane: mineur_farin::Atlas,
    /// The parameter that grows to the right.
    pub across: &'static Parameter,
    /// The parameter that grows upwards.
    pub up: &'static Parameter,
    /// What the bound is that is drawn, in words, if there is one.
    pub bound: Option<&'static str>,
}

impl PartialEq for Atlas {
    /// Parameters are told apart by their names.
    fn eq(&self, other: &Self) -> bool {
        let names = |atlas: &Self| [atlas.across.name, atlas.up.name];
        self.plane == other.plane && names(self) == names(other)
    }
}

impl Atlas {
    /// The place of some values of the operation that offers the atlas, in shares of its width and
    /// height.
    pub fn place(&self, values: &Values) -> [f64; 2] {
        self.plane
            .place(values.real(self.across), values.real(self.up))
    }

    /// The values of a place.
    pub fn values(&self, place: [f64; 2]) -> [(&'static str, Value); 2] {
        let (across, up) = self.plane.at(place);
        [
            (self.across.name, Value::Real(across)),
            (self.up.name, Value::Real(up)),
        ]
    }
}

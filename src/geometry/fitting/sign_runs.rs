//! Members of a sequence whose signs change at given places.

/// The most members that one turn passes at once.
const FARTHEST: usize = 12;

/// The members at either end that keep the first and the last sign.
const END: usize = 2;

/// Multipliers below this share of the largest do not press.
const PRESSING: f64 = 1e-7;

/// The signs of a sequence: that of the first member, and before which members it changes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SignRuns {
    /// Whether the first members are positive.
    pub(super) begins_positive: bool,
    pub(super) cuts: Vec<usize>,
}

impl SignRuns {
    /// The sign of each of so many members.
    pub(super) fn signs(&self, members: usize) -> Vec<f64> {
        let begin = if self.begins_positive { 1.0 } else { -1.0 };
        let sign = |member: usize| match self.cuts.partition_point(|cut| *cut <= member) % 2 {
            0 => begin,
            _ => -begin,
        };
        (0..members).map(sign).collect()
    }

    /// Move the cuts apart until each inner run has `least` members, where there are enough.
    pub(super) fn spread(mut self, members: usize, least: usize) -> Self {
        let runs = self.cuts.len() + 1;
        let least = least.min(members / runs).max(END);
        let mut low = END;
        for cut in &mut self.cuts {
            *cut = (*cut).max(low);
            low = *cut + least;
        }
        let mut high = members.saturating_sub(END);
        for cut in self.cuts.iter_mut().rev() {
            *cut = (*cut).min(high);
            high = cut.saturating_sub(least);
        }
        self
    }

    /// Let each cut with pressing members on one side only pass these. Returns whether one moved.
    pub(super) fn slide(&mut self, press: &[f64], least: usize) -> bool {
        let most = press
            .iter()
            .fold(f64::MIN_POSITIVE, |most, it| most.max(*it));
        let presses = |member: usize| press.get(member).is_some_and(|it| *it > PRESSING * most);
        let mut moved = false;
        for index in 0..self.cuts.len() {
            let low = match index.checked_sub(1) {
                Some(before) => self.cuts[before] + least,
                None => END,
            };
            let high = match self.cuts.get(index + 1) {
                Some(next) => next.saturating_sub(least),
                None => press.len().saturating_sub(END),
            };
            let from = self.cuts[index];
            let [left, right] = [from.checked_sub(1).is_some_and(presses), presses(from)];
            if left == right {
                continue;
            }
            let mut cut = from;
            while cut.abs_diff(from) < FARTHEST {
                let next = if left { cut - 1 } else { cut + 1 };
                let passed = cut.min(next);
                if next < low || next > high || !presses(passed) {
                    break;
                }
                cut = next;
            }
            moved |= cut != from;
            self.cuts[index] = cut;
        }
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn runs(cuts: &[usize]) -> SignRuns {
        SignRuns {
            begins_positive: true,
            cuts: cuts.to_vec(),
        }
    }

    #[test]
    fn signs_change_at_the_cuts_and_cuts_keep_apart() {
        assert_eq!(runs(&[2, 3]).signs(5), [1.0, 1.0, -1.0, 1.0, 1.0]);
        assert_eq!(runs(&[0, 1, 30]).spread(20, 5).cuts, [2, 7, 18]);
        assert_eq!(runs(&[17, 18]).spread(20, 5).cuts, [13, 18]);
    }

    #[test]
    fn cuts_pass_members_that_press_on_one_side() {
        let mut press = vec![0.0; 20];
        press[10] = 1.0;
        press[11] = 0.5;
        let mut sequence = runs(&[10]);
        assert!(sequence.slide(&press, 5));
        assert_eq!(sequence.cuts, [12]);
        assert!(!sequence.slide(&press, 5) || sequence.cuts == [10]);
        press[9] = 1.0;
        let mut held = runs(&[10]);
        assert!(!held.slide(&press, 5));
    }
}

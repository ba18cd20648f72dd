//! The deviation between the active curve or reference and the one that it is compared with.

use std::sync::Arc;

use super::Client;
use super::patience::Patience;
use crate::analysis::{Deviation, Item};
use crate::document::CurveId;

/// Measure deviations beside the frame, of one pair at a time.
#[derive(Debug, Default)]
pub struct Comparing {
    client: Client<Pair, Arc<Compared>>,
    /// The last deviation of the same two items: while one of them is changed it stays until the next.
    shown: Option<Arc<Compared>>,
}

/// A measured deviation.
#[derive(Debug)]
struct Compared {
    deviation: Deviation,
    /// The same without the points past an end of a curve.
    within_ends: Option<Deviation>,
}

/// Two curves or references that are measured against each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The two items.
    pub ids: [CurveId; 2],
    /// Their states.
    pub items: [Item; 2],
}

impl Comparing {
    /// Measure on a thread, which calls `wake` when a deviation is measured.
    pub fn background(wake: impl Fn() + Send + 'static) -> Self {
        Self {
            client: Client::background("distances", wake),
            shown: None,
        }
    }

    /// Take the result, and start the measurement of a pair that has changed.
    pub fn advance(&mut self, pair: Option<Pair>, patience: &mut Patience) {
        let ids = |pair: &Pair| pair.ids;
        if self.client.request().map(ids) != pair.as_ref().map(ids) {
            self.shown = None;
        }
        self.client.advance(pair, Some(patience), |pair| {
            move |progress: &_| {
                let deviation = Deviation::measure(pair.items.each_ref(), progress).ok()??;
                Some(Arc::new(Compared {
                    within_ends: deviation.within_ends(),
                    deviation,
                }))
            }
        });
        if self.client.progress().is_none() {
            self.shown = self.client.result().cloned();
        }
    }

    /// The deviation of the pair; `None` until it is measured, and if it cannot be.
    pub fn deviation(&self) -> Option<&Deviation> {
        self.shown.as_ref().map(|shown| &shown.deviation)
    }

    /// The deviation without the points past an end of a curve; `None` also if there are no such points, or no others.
    pub fn within_ends(&self) -> Option<&Deviation> {
        self.shown.as_ref()?.within_ends.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;
    use std::time::Duration;

    use super::*;
    use crate::document::{Curve, Document};
    use crate::geometry::FloatPolygon;

    /// Longer than any job here takes.
    const LONG: Duration = Duration::from_secs(60);

    /// A straight curve, `offset` above the x-axis.
    fn line(offset: f64) -> Arc<Curve> {
        let points = [(0.0, offset), (1.0, offset), (2.0, offset)];
        let polygon = FloatPolygon::planar(2, &points).expect("a polygon");
        Arc::new(Curve::new("line".to_owned(), polygon))
    }

    fn pair(ids: [CurveId; 2], offset: f64) -> Pair {
        Pair {
            ids,
            items: [0.0, offset].map(|offset| Item::Curve(line(offset))),
        }
    }

    fn largest(comparing: &Comparing) -> Option<f64> {
        comparing
            .deviation()?
            .largest()
            .map(|(_, it)| it.distance())
    }

    #[test]
    fn a_deviation_is_shown_of_its_own_pair_only() {
        let ids: Vec<CurveId> = Document::default().next_ids().take(3).collect();
        let [one, two] = [[ids[0], ids[1]], [ids[0], ids[2]]];
        let (sender, woken) = channel();
        let wake = move || sender.send(()).unwrap_or_default();
        let mut comparing = Comparing::background(wake);
        let mut patient = Patience::new(LONG);
        let mut hasty = Patience::default();
        comparing.advance(Some(pair(one, 1.0)), &mut patient);
        assert_eq!(largest(&comparing), Some(1.0));

        // The thread is held, so that no later job begins.
        let (lets_go, held) = channel::<()>();
        let (begins, begun) = channel();
        let job = move |_: &_| {
            begins.send(()).unwrap_or_default();
            held.recv().unwrap_or_default();
            None
        };
        comparing.client.start(pair(one, 2.0), job, None);
        begun.recv_timeout(LONG).expect("the job begins");
        comparing.advance(Some(pair(one, 3.0)), &mut hasty);
        assert_eq!(largest(&comparing), Some(1.0), "the last state of the pair");
        let other = pair(two, 4.0);
        comparing.advance(Some(other.clone()), &mut hasty);
        assert_eq!(largest(&comparing), None, "not that of another pair");
        lets_go.send(()).expect("the job is held");
        while comparing.client.progress().is_some() {
            woken.recv_timeout(LONG).expect("the frame is woken");
            comparing.advance(Some(other.clone()), &mut hasty);
        }
        assert_eq!(largest(&comparing), Some(4.0));
    }

    #[test]
    fn a_panic_leaves_no_deviation_of_an_earlier_state() {
        let ids: Vec<CurveId> = Document::default().next_ids().take(2).collect();
        let mut comparing = Comparing::default();
        let mut patience = Patience::default();
        comparing.advance(Some(pair([ids[0], ids[1]], 1.0)), &mut patience);
        assert_eq!(largest(&comparing), Some(1.0));
        let changed = pair([ids[0], ids[1]], 2.0);
        comparing
            .client
            .start(changed.clone(), |_| panic!("on purpose"), None);
        comparing.advance(Some(changed), &mut patience);
        assert_eq!(largest(&comparing), None);
    }
}

//! The Pareto front of error against cost, and the price of each tenfold of accuracy along it.
//!
//! An offer is on the front if none has at most its error at at most its cost. From one offer of the front to the next, error falls
//! by some decades and cost rises by some factor; the price of a tenfold is that factor per decade, so that steps of any
//! length can be compared: `(c1 / c0) ^ (1 / log10(e0 / e1))`. To an error of 0 there is no number of decades: only the factor is told.

/// What one strategy offers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Offer {
    /// Error, 0 or more.
    pub error: f64,
    /// Cost, more than 0.
    pub cost: f64,
    /// Median absolute deviation of the cost.
    pub spread: f64,
}

/// From one offer of a front to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    /// Index of the cheaper offer.
    pub from: usize,
    /// Index of the more accurate offer.
    pub to: usize,
    /// Decades of error between them; none where the second has no error.
    pub decades: Option<f64>,
    /// Cost of the second over that of the first.
    pub cost_ratio: f64,
    /// Factor of cost for a tenfold less error; none where the second has no error.
    pub price: Option<f64>,
    /// Whether the two costs lie within the sum of their spreads: the step may be free.
    pub is_within_spread: bool,
}

/// Indices of the offers on the front, the cheapest first. Of equal offers the first is taken.
pub(crate) fn front(offers: &[Offer]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..offers.len()).collect();
    order.sort_by(|a, b| {
        let (a, b) = (&offers[*a], &offers[*b]);
        a.cost.total_cmp(&b.cost).then(a.error.total_cmp(&b.error))
    });
    let mut least = f64::INFINITY;
    order.retain(|i| {
        let is_better = offers[*i].error < least;
        least = least.min(offers[*i].error);
        is_better
    });
    order
}

/// The steps along a front.
pub(crate) fn steps(offers: &[Offer], front: &[usize]) -> Vec<Step> {
    let pairs = front.windows(2);
    pairs
        .map(|pair| {
            let (from, to) = (pair[0], pair[1]);
            let (a, b) = (&offers[from], &offers[to]);
            let cost_ratio = b.cost / a.cost;
            let decades = (b.error > 0.0).then(|| (a.error / b.error).log10());
            Step {
                from,
                to,
                decades,
                cost_ratio,
                price: decades.map(|d| cost_ratio.powf(d.recip())),
                is_within_spread: b.cost - a.cost <= a.spread + b.spread,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn offers(pairs: &[(f64, f64)]) -> Vec<Offer> {
        let offer = |(error, cost): &(f64, f64)| Offer {
            error: *error,
            cost: *cost,
            spread: 0.1,
        };
        pairs.iter().map(offer).collect()
    }

    #[test]
    fn the_front_leaves_out_what_another_beats() {
        // Error falls as the square of cost; the third is beaten by the second, the last is the second again.
        let all = offers(&[
            (100.0, 1.0),
            (1.0, 10.0),
            (2.0, 11.0),
            (0.0, 40.0),
            (1.0, 10.0),
        ]);
        assert_eq!(front(&all), [0, 1, 3]);
        assert_eq!(front(&[]), [0usize; 0]);
        // One that is both cheapest and best is alone.
        assert_eq!(front(&offers(&[(5.0, 2.0), (0.0, 1.0)])), [1]);
    }

    #[test]
    fn the_price_of_a_tenfold_does_not_hang_on_the_length_of_the_step() {
        // cost = error ^ -0.5: a tenfold costs the square root of 10, whatever is sampled.
        for errors in [[1000.0, 10.0, 1.0], [700.0, 90.0, 0.3]] {
            let pairs = errors.map(|e: f64| (e, e.powf(-0.5)));
            let all = offers(&pairs);
            let steps = steps(&all, &front(&all));
            assert_eq!(steps.len(), 2);
            for step in steps {
                let price = step.price.unwrap();
                assert!((price - 10_f64.sqrt()).abs() < 1e-12, "{price}");
            }
        }
    }

    #[test]
    fn to_no_error_there_are_no_decades() {
        let all = offers(&[(50.0, 2.0), (0.0, 3.0), (5.0, 2.1)]);
        let steps = steps(&all, &front(&all));
        assert!(steps[0].is_within_spread, "2.0 and 2.1 ± 0.1 each");
        assert_eq!(steps[0].decades, Some(1.0));
        let last = steps[1];
        assert_eq!(
            (last.from, last.to, last.decades, last.price),
            (2, 1, None, None)
        );
        assert!((last.cost_ratio - 3.0 / 2.1).abs() < 1e-12, "{last:?}");
        assert!(!last.is_within_spread, "{last:?}");
    }
}

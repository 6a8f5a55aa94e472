//! Rate limit on wrong tokens.

use std::collections::BTreeMap;
use std::net::IpAddr;
use std::sync::{Mutex, MutexGuard, PoisonError};

use periplus_os::Stopwatch;

/// Burst of wrong tokens allowed per address.
const MAX_WRONG_TOKENS: f64 = 10.0;

/// Sustained rate of wrong tokens allowed per address \[1/s\].
const WRONG_TOKENS_PER_S: f64 = 0.1;

/// Maximum number of addresses stored.
const MAX_ADDRESSES: usize = 4096;

/// Wrong tokens by address.
#[derive(Debug, Default)]
pub(crate) struct TokenRateLimit {
    by_address: Mutex<BTreeMap<IpAddr, Wrong>>,
}

#[derive(Debug)]
struct Wrong {
    count: f64,
    since: Stopwatch,
}

impl Wrong {
    /// Current count of the address.
    fn now(&self) -> f64 {
        (self.count - self.since.elapsed().as_secs_f64() * WRONG_TOKENS_PER_S).max(0.0)
    }
}

impl TokenRateLimit {
    fn known(&self) -> MutexGuard<'_, BTreeMap<IpAddr, Wrong>> {
        self.by_address.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// True if the address has sent too many wrong tokens to try another one.
    pub(crate) fn are_too_many(&self, address: IpAddr) -> bool {
        let known = self.known();
        known.get(&address).is_some_and(|wrong| wrong.now() > MAX_WRONG_TOKENS - 1.0)
    }

    /// Counts a wrong token of the address.
    pub(crate) fn add(&self, address: IpAddr) {
        let mut known = self.known();
        if known.len() >= MAX_ADDRESSES {
            known.retain(|_, wrong| wrong.now() > 0.0);
        }
        if known.len() >= MAX_ADDRESSES {
            // An attack from many machines: the address with the fewest wrong tokens is dropped.
            let fewest = known.iter().min_by(|a, b| a.1.now().total_cmp(&b.1.now()));
            if let Some(fewest) = fewest.map(|(address, _)| *address) {
                known.remove(&fewest);
            }
        }
        let count = known.get(&address).map_or(0.0, Wrong::now) + 1.0;
        known.insert(address, Wrong { count, since: Stopwatch::start() });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_has_ten_guesses_and_others_have_theirs() {
        let (token_rate_limit, own, other) =
            (TokenRateLimit::default(), [10, 0, 0, 1].into(), [10, 0, 0, 2].into());
        for _ in 0..10 {
            assert!(!token_rate_limit.are_too_many(own));
            token_rate_limit.add(own);
        }
        assert!(token_rate_limit.are_too_many(own) && !token_rate_limit.are_too_many(other));
    }

    #[test]
    fn many_addresses_take_bounded_memory() {
        let token_rate_limit = TokenRateLimit::default();
        (0..10_000_u32).for_each(|n| token_rate_limit.add(IpAddr::from(n.to_be_bytes())));
        assert_eq!(token_rate_limit.known().len(), MAX_ADDRESSES);
    }
}

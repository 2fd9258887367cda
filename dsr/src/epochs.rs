//! The present life of each agent, by number.

use rustc_hash::FxHashMap;

use crate::id::{AgentId, Epoch};
use crate::transaction::{Edit, Transaction, TransactionError};
use crate::vocabulary::Vocabulary;

/// The present lives of agents; one that was never attended nor expired has the first.
#[derive(Debug, Default)]
pub(crate) struct Epochs(FxHashMap<AgentId, Epoch>);

impl Epochs {
    /// Ends the present life of an agent, and begins the next.
    pub(crate) fn next(&mut self, agent: AgentId) -> Epoch {
        let epoch = self.0.entry(agent).or_default();
        epoch.0 += 1;
        *epoch
    }

    /// Fails if the transaction was written for a life that is over.
    pub(crate) fn admit(
        &self,
        transaction: &Transaction,
        vocabulary: &Vocabulary,
    ) -> Result<(), TransactionError> {
        let Some((agent, epoch)) = transaction.life else { return Ok(()) };
        if self.0.get(&agent).copied().unwrap_or_default() == epoch {
            return Ok(());
        }
        let name = vocabulary.agent_name(agent);
        Err(name.map_or(TransactionError::UnknownAgent { id: agent }, |agent| TransactionError::Fenced {
            agent: agent.clone(),
        }))
    }

    /// Ends the lives of the agents that a transaction has expired.
    pub(crate) fn follow(&mut self, transaction: &Transaction) {
        for edit in &transaction.edits {
            if let Edit::Expire { agent } = edit {
                self.next(*agent);
            }
        }
    }
}

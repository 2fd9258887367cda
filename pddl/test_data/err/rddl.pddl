domain reservoir_mdp {
  requirements = { reward-deterministic };
  types { res: object; };
}

"""Machine checks of the lemmas of proof.md: identities in exact algebra, inequalities in ball arithmetic."""

"""Machine checks of the lemmas of docs/proof.md: identities in exact algebra, inequalities in ball arithmetic."""

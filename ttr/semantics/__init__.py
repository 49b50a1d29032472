"""What the literature builds on the core, each in a room of its own.

`perceptual` meanings with classifiers, `learning` from judgements, `quantifiers` by
witness sets, `modality`, `questions`, `gameboards`, a `fragment` of English, `topoi`,
`string_prediction`, `parametric_content`, `propositional_entailment`,
`random_variables`. May import: theories and all below.
"""

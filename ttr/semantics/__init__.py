"""What the literature builds on the core of the theory, each in a room of its own.

To be read in any order, the small ones first:

- `questions` (Ginzburg 2012), and `gameboards` built on them (Cooper 2023, Ginzburg
  2012, Larsson 2002);
- `quantifiers` by witness sets and `parametric_content` (Cooper 2023), and a `fragment`
  of English built on both;
- `storage` of quantifiers (Cooper 2023);
- `attitudes` (Cooper 2023): believing and knowing by matching a view;
- `modality` (Cooper 2023), and `topoi`, which use its answers (Breitholtz 2020);
- `propositional_entailment`, `random_variables`, and `learning` from judgements
  (Cooper, Dobnik, Lappin and Larsson 2015);
- `perceptual` meanings with classifiers (Larsson 2013), which may be learners;
- `string_prediction` (Fernando 2007; Cooper 2023).

`argument_checks` is shared by all. May import: theories and all below.
"""

"""What the grammar does not read as a whole is read by its islands, and by the state.

The grammar stays the reference: each reading of an island is the type of a move, as if
it had been said alone. How well an island fits depends on what the talk is about: "yes"
where the robot has claimed something, "the red one" where it has asked which.

| room | holds |
| --- | --- |
| `clause_words` | the words of a sentence, by clauses, and which are harmless |
| `self_repairs` | what a speaker sets right themselves |
| `islands` | the stretches that the grammar reads |
| `situations` | what the talk is about |
| `island_kinds` | which islands are treated alike |
| `island_weights` | how well each fits what the talk is about |
| `island_covers` | islands that do not overlap |
| `admissible_covers` | which of them may stand together |
| `doubted_claims` | why a claim is asked about, or is none |
| `rivals` | other ways to take a sentence |
| `sentence_reading` | a sentence, read by its best cover |
| `whole_sentences` | whether the whole or the parts are the better reading |
| `lessons_together` | lessons of one breath, asked about together |
| `text_hearing` | what is heard of a text of several sentences |
| `speech_hearing` | what is heard where only hypotheses of the text are known |
"""

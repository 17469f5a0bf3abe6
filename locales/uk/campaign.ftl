# Кампанія: навички, замки, деталі.
skill-arming = перевірки та озброєння моторів
skill-commands = режими та команди
skill-navigation = політ до точки
skill-energy = енергія
skill-links = зв'язок і аварійні дії
skill-coverage = покриття площі
skill-sensors = читання датчиків
skill-threats = відповідь на загрози
skill-separation = рознесення та повітряний простір
skill-swarm = керування роєм
skill-design = проєктування дронів
skill-judgement = оцінка самого себе
skill-prediction = передбачення балів

locked-pass = пройдіть «{ $mission }»
locked-medal = здобудьте медаль ({ $medal }) у «{ $mission }»
locked-skill = { $skill }: { $has } %, треба { $wanted } %
locked-licence = треба ліцензію на { $wanted } дронів, ваша на { $has }

buy-unknown = такої деталі немає
buy-owned = вона вже ваша
buy-locked = спершу пройдіть { $mission }
buy-too-dear = вона коштує { $price } кредитів, у вас { $credits }

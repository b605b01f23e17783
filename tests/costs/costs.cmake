# Read by ctest: seconds of processor time of the dearest entries, by scripts/test-times. On a tree where nothing has run yet ctest
# starts them first, so that none comes last alone; afterwards it knows from its own runs. Names that are not there do no harm.
set_tests_properties(npm.ssphh PROPERTIES COST 25)
set_tests_properties(test_cooked PROPERTIES COST 22)
set_tests_properties(test_view.View PROPERTIES COST 19)
set_tests_properties(test_pictures.BakedLight PROPERTIES COST 14)
set_tests_properties(test_cli.Methods test_render.RecordPlaces PROPERTIES COST 12)
set_tests_properties(test_cli.TransportBakeCli scripts.figures python.bake test_cli.LightmapTool
                     test_cli.Web test_farm_processes.FarmBake PROPERTIES COST 10)
set_tests_properties(test_render.LightModesInPictures test_render.Ddgi test_render.Prt test_viewer.StillPicture test_cli.BakeUpdate
                     test_cli.Relight test_cli.KeyedRelight PROPERTIES COST 8)
set_tests_properties(test_pictures.Builtin/OneTruth test_pictures.RendererTest test_render.GiTransportBake test_render.Vct
                     test_render.Builtin/TransportTruth test_render.IrradianceVolume test_render.GlassTransport python.docs
                     test_cli.BadInput python.relight PROPERTIES COST 6)
# Which sleep or wait for others.
set_tests_properties(test_farm_processes.FarmNetwork test_majordomo.Curve test_majordomo.UnrulyNetwork test_cli.BakeWatch
                     PROPERTIES COST 5)
